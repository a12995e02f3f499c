// Laws that stiffen against their closed forms: homogeneous states of a distorted block, and an inflated
// tube.
#include "tests/support/not_empty.hpp"
#include "tests/verify/homogeneous.hpp"
#include "tests/verify/references.hpp"

namespace bulbus {
namespace {

RegionSpec fung() {
  RegionSpec r;
  r.fung = FungSpec{.2, 2.5};
  return r;
}

constexpr double c10 = .05, k1 = .08, k2 = 3, half_angle = .6;  // rad, of both families to the x direction

Vec3<double> along(int family) {
  return {std::cos(half_angle), (family == 0 ? 1 : -1) * std::sin(half_angle), 0};
}

/// Two families in the plane of x and y.
RegionSpec crossed(double dispersion) {
  RegionSpec r;
  r.c10 = c10;
  r.fibres = FibresSpec{k1, k2, dispersion, {}};
  for (int i = 0; i < 2; ++i) {
    FibreFamilySpec family;
    family.direction = {number(along(i)[0]), number(along(i)[1]), "0"};
    r.fibres->families.push_back(family);
  }
  return r;
}

Mat3<double> transposed(const Mat3<double>& a) {
  Mat3<double> t;
  for (int i = 0; i < 9; ++i) t(i / 3, i % 3) = a(i % 3, i / 3);
  return t;
}

/// σ = F S Fᵀ − p I of S = 2 ∂W/∂C and det F = 1, with p from σ_zz = 0.
Mat3<double> free_in_z(const Mat3<double>& F, const Mat3<double>& S) {
  Mat3<double> cauchy = F * S * transposed(F);
  const double p = cauchy(2, 2);
  for (int i = 0; i < 3; ++i) cauchy(i, i) -= p;
  return cauchy;
}

Mat3<double> fung_stress(const Mat3<double>& F) {
  const double e = .2 * std::exp(2.5 * (trace(transposed(F) * F) - 3));
  return free_in_z(F, diagonal(e, e, e));
}

Mat3<double> crossed_stress(const Mat3<double>& F, double kappa) {
  const Mat3<double> C = transposed(F) * F;
  Mat3<double> S = diagonal(2 * c10, 2 * c10, 2 * c10);
  for (int i = 0; i < 2; ++i) {
    const Vec3<double> M = along(i);
    double I4 = 0;
    for (int r = 0; r < 9; ++r) I4 += M[r / 3] * M[r % 3] * C(r / 3, r % 3);
    const double E = std::max(0., kappa * (trace(C) - 3) + (1 - 3 * kappa) * (I4 - 1)),
                 slope = 2 * k1 * E * std::exp(k2 * E * E);
    for (int r = 0; r < 9; ++r)
      S(r / 3, r % 3) += slope * (kappa * (r % 4 == 0) + (1 - 3 * kappa) * M[r / 3] * M[r % 3]);
  }
  return free_in_z(F, S);
}

/// A law as it is given to a region, and its stress.
struct Law {
  std::string name;
  RegionSpec spec;
  std::function<Mat3<double>(const Mat3<double>&)> stress;
};

std::vector<Law> laws() {
  std::vector<Law> all{{"Fung", fung(), fung_stress}};
  for (double kappa : {0., .1, .226})
    all.push_back({fmt::format("fibres, kappa {}", kappa), crossed(kappa),
                   [kappa](const Mat3<double>& F) { return crossed_stress(F, kappa); }});
  return all;
}

/// P = σ F⁻ᵀ of a diagonal F.
Mat3<double> nominal(const Mat3<double>& cauchy, const Mat3<double>& F) {
  Mat3<double> P = cauchy;
  for (int i = 0; i < 9; ++i) P(i / 3, i % 3) /= F(i % 3, i % 3);
  return P;
}

void expect_exact(const Law& law, const std::string& state, double error) {
  EXPECT_LT(error, 1e-9) << law.name << ", " << state;
  measured("{}, {}: largest relative error of the stresses {:.1e} (target 1e-9)", law.name, state, error);
}

/// The stretch in y with which σ_yy vanishes under a stretch in x.
double free_stretch(const Law& law, double x) {
  double low = .3, high = 1.7;
  for (int i = 0; i < 80; ++i) {
    const double y = (low + high) / 2;
    (law.stress(diagonal(x, y, 1 / (x * y)))(1, 1) > 0 ? high : low) = y;
  }
  return low;
}

TEST(Laws, Uniaxial) {
  for (const Law& law : laws())
    for (double x : {.85, 1.15, 1.3}) {
      const double y = free_stretch(law, x);
      const Mat3<double> F = diagonal(x, y, 1 / (x * y)), cauchy = law.stress(F);
      expect_exact(law, fmt::format("uniaxial {}", x),
                   error_of(stretched(law.spec, x, {}, {}), cauchy, nominal(cauchy, F)));
    }
}

TEST(Laws, Biaxial) {
  for (const Law& law : laws())
    for (const auto& [x, y] : {std::pair{1.2, 1.2}, {1.25, 1.1}, {1.2, .9}}) {
      const Mat3<double> F = diagonal(x, y, 1 / (x * y)), cauchy = law.stress(F);
      expect_exact(law, fmt::format("biaxial {}, {}", x, y),
                   error_of(stretched(law.spec, x, y, {}), cauchy, nominal(cauchy, F)));
    }
}

TEST(Laws, SimpleShear) {
  for (const Law& law : laws())
    for (double g : {.2, .5}) {
      const Mat3<double> F{{{{1, g, 0}, {0, 1, 0}, {0, 0, 1}}}}, cauchy = law.stress(F);
      Mat3<double> P = cauchy;  // F⁻ᵀ = I − γ e2 ⊗ e1
      for (int i = 0; i < 3; ++i) P(i, 0) -= g * cauchy(i, 1);
      expect_exact(law, fmt::format("simple shear {}", g), error_of(sheared(law.spec, g), cauchy, P));
    }
}

// exp(2000 (Ī1 − 3)) overflows from a stretch of .38 on, and long before it no increment comes to its end:
// what is left is the last state in equilibrium.
TEST(Laws, OverflowingExponentialIsCutAndNotAccepted) {
  RegionSpec law = fung();
  law.fung->b = 2000;
  Scene scene = stretched(law, 2, {}, {});
  scene.model.steps[0].increments = 1;
  Trial run(scene);
  run.direct();
  EXPECT_FALSE(run.report.converged);
  for (const Increment& i : run.increments) EXPECT_TRUE(std::isfinite(i.newton.error.force));
  EXPECT_GT(run.report.cuts, 0);
  EXPECT_TRUE(std::isfinite(largest(run.state.x)) && std::isfinite(largest(run.state.lambda)));
  EXPECT_TRUE(std::isfinite(run.problem.solid().energy(run.state.x)));
}

constexpr double inner = 10, outer = 12, dispersion = .1;

/// A quarter of a tube whose length is kept, with families at `half_angle` to its circles: n × 2n × 1 cells.
Scene tube(int n, double pressure) {
  Scene scene{generate(BlockShape{.nx = n, .ny = 2 * n, .nz = 1}), {}};
  for (Point& p : scene.mesh.points) {
    const double r = inner + (outer - inner) * p[0], angle = M_PI / 2 * p[1];
    p = {p[1] == 1 ? 0 : r * std::cos(angle), r * std::sin(angle), p[2]};
  }
  RegionSpec& law = scene.model.regions["block"] = crossed(dispersion);
  const double c = std::cos(half_angle), s = std::sin(half_angle);
  for (int i = 0; i < 2; ++i)
    law.fibres->families[i].direction = {fmt::format("{:.17g}*Y", -c), fmt::format("{:.17g}*X", c),
                                         fmt::format("{:.17g}*sqrt(X^2 + Y^2)", i == 0 ? s : -s)};
  scene.model.symmetry = {"x", "y", "z"};
  scene.model.fix.push_back({"zmax", {"z"}});
  StepSpec s1 = step("inflate", 4);
  LoadSpec load;
  load.surface = "xmin", load.pressure = number(pressure);
  s1.loads.push_back(load);
  scene.model.steps.push_back(s1);
  return scene;
}

/// p = ∫ (σ_θθ − σ_rr) dr/r of the tube whose inner radius grows to `a`; r² − a² = R² − A². Simpson's rule.
double tube_pressure(double a) {
  const auto integrand = [&](double R) {
    const double r = std::sqrt(a * a + R * R - inner * inner), hoop = std::pow(r / R, 2), radial = 1 / hoop;
    const double E = dispersion * (hoop + radial - 2) +
                     (1 - 3 * dispersion) *
                         (hoop * std::pow(std::cos(half_angle), 2) + std::pow(std::sin(half_angle), 2) - 1);
    const double slope = 2 * 2 * k1 * E * std::exp(k2 * E * E);  // both families
    const double difference =
        2 * c10 * (hoop - radial) + slope * (dispersion * (hoop - radial) +
                                             (1 - 3 * dispersion) * hoop * std::pow(std::cos(half_angle), 2));
    return difference * R / (r * r);
  };
  constexpr int parts = 200;
  const double h = (outer - inner) / parts;
  double sum = integrand(inner) + integrand(outer);
  for (int i = 1; i < parts; ++i) sum += (i % 2 == 1 ? 4 : 2) * integrand(inner + i * h);
  return sum * h / 3;
}

double mean_inner_radius(const Scene& scene, const Trial& run) {
  double sum = 0;
  const auto nodes = run.nodes(scene.mesh, "xmin");
  for (int n : nodes) sum += std::hypot(run.state.x[3 * n], run.state.x[3 * n + 1]);
  return sum / static_cast<double>(nodes.size());
}

TEST(Laws, InflatedTubeConvergesWithSecondOrder) {
  for (double a : {10.5, 12.}) {
    double error[2];
    for (int i = 0; i < 2; ++i) {
      const Scene scene = tube(4 << i, tube_pressure(a));
      Trial run(scene);
      run.settings.newton = tight(1e-10);
      run.direct();
      ASSERT_TRUE(run.report.converged) << run.report.reason;
      error[i] = std::abs(mean_inner_radius(scene, run) - a) / (a - inner);
    }
    measured(
        "tube with two families, inner radius {} -> {}: displacement off by {:.3f} % and {:.3f} %, order "
        "{:.2f}",
        inner, a, 100 * error[0], 100 * error[1], std::log2(error[0] / error[1]));
    EXPECT_LT(error[1], .01);
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2, .2);
  }
}

/// The block of data/references/fibre_block.py.
Scene fibre_block(double kappa) {
  Scene scene{generate(BlockShape{.upper = {2, 1, 1}, .nx = 4, .ny = 3, .nz = 3}), {}};
  for (Point& p : scene.mesh.points) {
    const double bump = std::sin(M_PI / 2 * p[0]) * std::sin(M_PI * p[1]) * std::sin(M_PI * p[2]);
    p = {p[0] + .06 * bump, p[1] - .05 * bump, p[2] + .04 * bump};
  }
  RegionSpec& law = scene.model.regions["block"] = crossed(kappa);
  for (int i = 0; i < 2; ++i)
    law.fibres->families[i].direction = {"cos(.6 + .3*X)", i == 0 ? "sin(.6 + .3*X)" : "-sin(.6 + .3*X)",
                                         "0"};
  scene.model.fix.push_back({"xmin", {"x", "y", "z"}});
  StepSpec pull = step("pull", 10);
  LoadSpec load;
  load.surface = "xmax", load.dead = true, load.direction = {.06, .02, .01};
  load.pressure = number(norm(load.direction));
  pull.loads.push_back(load);
  scene.model.steps.push_back(pull);
  return scene;
}

TEST(Laws, FibreBlockIsThatOfAnotherCode) {
  std::map<double, std::unique_ptr<Trial>> runs;
  double worst = 0;
  for (const auto& r : not_empty(references("fibre_block.csv"))) {
    const Scene scene = fibre_block(r["kappa"]);
    auto& run = runs[r["kappa"]];
    if (!run) {
      run = std::make_unique<Trial>(scene);
      run->settings.newton = tight(1e-12);
      run->direct();
      ASSERT_TRUE(run->report.converged) << run->report.reason;
    }
    const auto corner = nodes_where(scene.mesh, [&](const Point& p) {
      return std::hypot(p[0] - r["X"], p[1] - r["Y"], p[2] - r["Z"]) < 1e-9;
    });
    ASSERT_EQ(corner.size(), 1u);
    const char* names[3] = {"ux", "uy", "uz"};
    for (int c = 0; c < 3; ++c)
      worst =
          worse(worst, std::abs(run->displacement(run->problem.mesh().local(corner[0]), c) - r[names[c]]));
  }
  measured("fibre block: displacements differ from those of another code by {:.1e} mm", worst);
  EXPECT_LT(worst, 1e-10);
}

TEST(Laws, IterativeIsDirectWithFibres) {
  const Scene scene = tube(4, tube_pressure(11));
  Trial direct(scene), iterative(scene);
  direct.direct();
  iterative.iterative();
  ASSERT_TRUE(direct.report.converged && iterative.report.converged);
  EXPECT_LT(relative_difference(iterative.state.x, direct.state.x), 1e-9);
  measured("tube with two families: at most {} Krylov iterations a solve", most_krylov(iterative));
  EXPECT_LT(most_krylov(iterative), 100);
}

}  // namespace
}  // namespace bulbus
