#pragma once
#include "tests/verify/run.hpp"

namespace bulbus {

/// Unit cube of 3³ cells whose nodes are shaken, on its faces within the face.
inline Mesh shaken_cube() {
  Mesh mesh = generate(BlockShape{.nx = 3, .ny = 3, .nz = 3});
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    for (int c = 0; c < 3; ++c) {
      double& X = mesh.points[n][c];
      if (X > 0 && X < 1) X += .06 * noise(11, 3 * n + c);
    }
  return mesh;
}

inline std::string number(double v) { return fmt::format("{:.17g}", v); }

inline Scene cube(const RegionSpec& law) {
  Scene scene{shaken_cube(), {}};
  scene.model.regions["block"] = law;
  scene.model.steps.push_back(step("load", 6));
  return scene;
}

inline Scene stretched(const RegionSpec& law, std::optional<double> x, std::optional<double> y,
                       std::optional<double> z) {
  Scene scene = cube(law);
  scene.model.symmetry = {"x", "y", "z"};
  const auto pull = [&](const char* set, std::optional<double> stretch,
                        std::optional<std::string> DisplaceSpec::*axis) {
    if (!stretch) return;
    DisplaceSpec d = displace(set);
    d.*axis = number(*stretch - 1);
    scene.model.steps[0].displace.push_back(d);
  };
  pull("xmax", x, &DisplaceSpec::x);
  pull("ymax", y, &DisplaceSpec::y);
  pull("zmax", z, &DisplaceSpec::z);
  return scene;
}

/// Four sides follow x = F X; the faces z = const are free but for symmetry.
inline Scene sheared(const RegionSpec& law, double gamma) {
  Scene scene = cube(law);
  scene.model.symmetry = {"z"};
  for (const char* set : {"xmin", "xmax", "ymin", "ymax"}) {
    DisplaceSpec d = displace(set);
    d.affine = {1, gamma, 0, 0, 1, 0, 0, 0, 1};
    scene.model.steps[0].displace.push_back(d);
  }
  return scene;
}

/// Largest deviation over the cells and of the mean nominal stress, relative to the largest stress of the
/// state.
inline double error_of(const Scene& scene, const Mat3<double>& cauchy, const Mat3<double>& nominal) {
  Trial run(scene);
  run.settings.newton = tight(1e-13);
  run.direct();
  EXPECT_TRUE(run.report.converged) << run.report.reason;
  double scale = 0, error = 0, nominal_scale = 0, nominal_error = 0;
  for (int i = 0; i < 9; ++i) {
    scale = std::max(scale, std::abs(cauchy(i / 3, i % 3)));
    nominal_scale = std::max(nominal_scale, std::abs(nominal(i / 3, i % 3)));
  }
  const int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
  for (const CellStress& s : run.problem.solid().stresses(run.state.x, run.state.lambda)) {
    double mises = 0;
    for (auto [i, j] : pairs) {
      error = worse(error, std::abs(s.cauchy(i, j) - cauchy(i, j)) / scale);
      mises += i == j ? std::pow(cauchy(i, i) - cauchy((i + 1) % 3, (i + 1) % 3), 2) / 2
                      : 3 * std::pow(cauchy(i, j), 2);
    }
    error = worse(error, std::abs(s.mises - std::sqrt(mises)) / scale);
  }
  const Mat3<double> P = run.virial();
  for (int i = 0; i < 9; ++i)
    nominal_error = worse(nominal_error, std::abs(P(i / 3, i % 3) - nominal(i / 3, i % 3)) / nominal_scale);
  return std::max(error, nominal_error);
}

inline Mat3<double> diagonal(double a, double b, double c) { return {{{{a, 0, 0}, {0, b, 0}, {0, 0, c}}}}; }

}  // namespace bulbus
