// A thick sphere under inner pressure.
#include "tests/support/not_empty.hpp"
#include "tests/verify/references.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

/// An octant of 12 n³ / 8 hexahedra: 96, 768, 6144 for n = 4, 8, 16.
Scene thick_sphere(int n, double pressure, int increments) {
  Scene scene{generate(ShellShape{.inner = 10, .outer = 12, .n = n, .layers = n / 2}), {}};
  Model& m = scene.model;
  m.regions["shell"] = neo_hooke(.0833);
  m.liquids["fluid"] = {.surface = "inner"};
  m.symmetry = {"x", "y", "z"};
  StepSpec s = step("inflate", increments);
  s.pressures["fluid"] = fmt::format("{:.17g}", pressure);
  m.steps.push_back(s);
  return scene;
}

struct Errors {
  double inner, outer;
};

Errors errors(int n, const ReferenceRow& r) {
  const Scene scene = thick_sphere(n, r["p_MPa"], r["p_MPa"] > .025 ? 4 : r["p_MPa"] > .008 ? 2 : 1);
  Trial run(scene);
  run.settings.newton = tight(1e-10);
  if (n > 8)
    run.iterative();
  else
    run.direct();
  EXPECT_TRUE(run.report.converged) << run.report.reason;
  return {relative(run.mean_radial(scene.mesh, "inner"), r["u_r_inner_mm"]),
          relative(run.mean_radial(scene.mesh, "outer"), r["u_r_outer_mm"])};
}

TEST(ThickSphere, ConvergesWithSecondOrderAtAllPressures) {
  const auto rows = references("thick_sphere_inflation_given_pressure.csv");
  ASSERT_EQ(rows.size(), 8u);
  for (const auto& r : not_empty(rows)) {
    const Errors coarse = errors(4, r), fine = errors(8, r);
    measured(
        "thick sphere, p = {}: inner u_r off by {:.3f} % (96) and {:.3f} % (768), order {:.2f}; outer {:.3f} "
        "% and {:.3f} %, order {:.2f}",
        r["p_MPa"], 100 * coarse.inner, 100 * fine.inner, std::log2(coarse.inner / fine.inner),
        100 * coarse.outer, 100 * fine.outer, std::log2(coarse.outer / fine.outer));
    if (r["p_MPa"] < .025) {
      EXPECT_LT(fine.inner, .0025);
    }
    EXPECT_NEAR(std::log2(coarse.inner / fine.inner), 2, .2);
    EXPECT_NEAR(std::log2(coarse.outer / fine.outer), 2, .2);
    if (r["p_MPa"] != .02) continue;
    const Errors finest = errors(16, r);
    measured(
        "thick sphere, p = {}: inner u_r off by {:.4f} % (6144), order {:.2f}; outer {:.4f} %, order {:.2f}",
        r["p_MPa"], 100 * finest.inner, std::log2(fine.inner / finest.inner), 100 * finest.outer,
        std::log2(fine.outer / finest.outer));
    EXPECT_NEAR(std::log2(fine.inner / finest.inner), 2, .1);
    EXPECT_NEAR(std::log2(fine.outer / finest.outer), 2, .1);
  }
}

}  // namespace
}  // namespace bulbus
