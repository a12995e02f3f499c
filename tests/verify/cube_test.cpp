// Homogeneous states of a distorted block: the element must give the closed forms to round-off.
#include "tests/support/not_empty.hpp"
#include "tests/verify/references.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

/// Unit cube of 3³ cells whose nodes are shaken, on its faces within the face.
Mesh shaken_cube() {
  Mesh mesh = generate(BlockShape{.nx = 3, .ny = 3, .nz = 3});
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
    for (int c = 0; c < 3; ++c) {
      double& X = mesh.points[n][c];
      if (X > 0 && X < 1) X += .06 * noise(11, 3 * n + c);
    }
  return mesh;
}

std::string number(double v) { return fmt::format("{:.17g}", v); }

Scene cube(const std::string& material) {
  Scene scene{shaken_cube(), {}};
  RegionSpec& r = scene.model.regions["block"];
  r.c10 = material == "nh" ? .0833 : .0633;
  r.c01 = material == "nh" ? 0 : .02;
  scene.model.steps.push_back(step("load", 6));
  return scene;
}

Scene stretched(const std::string& material, std::optional<double> x, std::optional<double> y,
                std::optional<double> z) {
  Scene scene = cube(material);
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
Scene sheared(const std::string& material, double gamma) {
  Scene scene = cube(material);
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
double error_of(const Scene& scene, const Mat3<double>& cauchy, const Mat3<double>& nominal) {
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

Mat3<double> diagonal(double a, double b, double c) { return {{{{a, 0, 0}, {0, b, 0}, {0, 0, c}}}}; }

class Cube : public testing::TestWithParam<const char*> {
 protected:
  std::vector<ReferenceRow> rows() const {
    std::vector<ReferenceRow> mine;
    for (const auto& r : references("cube_homogeneous.csv"))
      if (r.text("material") == GetParam()) mine.push_back(r);
    EXPECT_EQ(mine.size(), 15u);
    return mine;
  }
  template <class Error>
  void expect_exact(const char* what, Error error) const {
    double worst = 0;
    for (const auto& r : not_empty(rows())) {
      const double e = error(r);
      EXPECT_LT(e, 1e-9) << "lambda = " << r["lambda"];
      worst = worse(worst, e);
    }
    measured("cube, {} {}: largest relative error of the stresses {:.1e} (target 1e-9)", GetParam(), what,
             worst);
  }
};

TEST_P(Cube, Uniaxial) {
  expect_exact("uniaxial", [](const auto& r) {
    return error_of(stretched(GetParam(), r["lambda"], {}, {}), diagonal(r["uniaxial_Cauchy"], 0, 0),
                    diagonal(r["uniaxial_nominal"], 0, 0));
  });
}

TEST_P(Cube, Equibiaxial) {
  expect_exact("equibiaxial", [](const auto& r) {
    const double s = r["equibiax_Cauchy"], P = r["equibiax_nominal"];
    return error_of(stretched(GetParam(), r["lambda"], r["lambda"], {}), diagonal(s, s, 0),
                    diagonal(P, P, 0));
  });
}

TEST_P(Cube, PureShear) {
  expect_exact("pure shear", [](const auto& r) {
    return error_of(stretched(GetParam(), r["lambda"], 1, {}),
                    diagonal(r["pureshear_Cauchy_1"], r["pureshear_Cauchy_2(held)"], 0),
                    diagonal(r["pureshear_nominal_1"], r["pureshear_nominal_2"], 0));
  });
}

TEST_P(Cube, SimpleShear) {
  expect_exact("simple shear", [](const auto& r) {
    const double g = r["simpleshear_gamma"], s12 = r["simpleshear_s12"], s11 = r["simpleshear_s11-s33"],
                 s22 = r["simpleshear_s22-s33"];
    const Mat3<double> cauchy{{{{s11, s12, 0}, {s12, s22, 0}, {0, 0, 0}}}};
    // P = σ F⁻ᵀ, F⁻ᵀ = I − γ e2 ⊗ e1
    const Mat3<double> nominal{{{{s11 - g * s12, s12, 0}, {s12 - g * s22, s22, 0}, {0, 0, 0}}}};
    return error_of(sheared(GetParam(), g), cauchy, nominal);
  });
}

INSTANTIATE_TEST_SUITE_P(Materials, Cube, testing::Values("nh", "mr"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace bulbus
