// A thick sphere full of liquid under outside pressure, with liquid added, and both.
#include "tests/support/not_empty.hpp"
#include "tests/verify/references.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

Scene filled_sphere(int n, double outside, double beta) {
  Scene scene{generate(ShellShape{.inner = 10, .outer = 12, .n = n, .layers = n / 2}), {}};
  Model& m = scene.model;
  m.regions["shell"] = neo_hooke(.0833);
  m.liquids["fluid"] = {.surface = "inner"};
  m.symmetry = {"x", "y", "z"};
  StepSpec s = step("load", beta > .05 ? 4 : 1);
  s.enclose = {"fluid"};
  if (outside != 0) {
    LoadSpec load;
    load.surface = "outer", load.pressure = fmt::format("{:.17g} MPa", outside);
    s.loads.push_back(load);
  }
  m.steps.push_back(s);
  if (beta != 0) {  // as a part of the mesh's own volume
    const Problem still(scene.mesh, m, Comm(MPI_COMM_SELF));
    m.steps[0].add["fluid"] = beta * still.multiplicity() * still.liquids()[0].volume(still.mesh().X);
  }
  return scene;
}

struct Errors {
  double inner, outer, pressure, excess;
};

Errors errors(int n, const ReferenceRow& r) {
  const double outside = r["p_outside_MPa"];
  const Scene scene = filled_sphere(n, outside, r["beta_vol_expansion"]);
  Trial run(scene);
  // P - p_outside is a small part of P, so the balance must be closer than usual; with nothing but a small
  // strain to carry, round-off of the deformation gradient stands at 1e-11
  run.settings.newton = tight(outside > 0 ? 1e-12 : 1e-10, 1e-13);
  run.direct();
  EXPECT_TRUE(run.report.converged) << run.report.reason;
  return {relative(run.mean_radial(scene.mesh, "inner"), r["u_r_inner_mm"]),
          relative(run.mean_radial(scene.mesh, "outer"), r["u_r_outer_mm"]),
          relative(run.state.P[0], r["p_liquid_MPa"]),
          relative(run.state.P[0] - outside, r["p_liquid_minus_p_outside_MPa"])};
}

TEST(FilledSphere, ConvergesWithSecondOrder) {
  const auto rows = references("liquid_filled_sphere.csv");
  ASSERT_EQ(rows.size(), 15u);
  for (const auto& r : not_empty(rows)) {
    const Errors coarse = errors(4, r), fine = errors(8, r);
    const auto order = [](double c, double f) { return std::log2(c / f); };
    measured(
        "filled sphere, p_outside = {}, beta = {}: inner u_r {:.1e} {:.1e} order {:.2f}; outer {:.1e} {:.1e} "
        "order {:.2f}; P {:.1e} {:.1e} order {:.2f}; P - p_outside {:.1e} {:.1e} order {:.2f}",
        r["p_outside_MPa"], r["beta_vol_expansion"], coarse.inner, fine.inner,
        order(coarse.inner, fine.inner), coarse.outer, fine.outer, order(coarse.outer, fine.outer),
        coarse.pressure, fine.pressure, order(coarse.pressure, fine.pressure), coarse.excess, fine.excess,
        order(coarse.excess, fine.excess));
    // the liquid prescribes the volume, so that displacements converge even faster
    EXPECT_LT(fine.inner, 1e-4);
    EXPECT_LT(fine.outer, 1e-4);
    EXPECT_GT(order(coarse.inner, fine.inner), 1.9);
    EXPECT_GT(order(coarse.outer, fine.outer), 1.9);
    EXPECT_LT(fine.excess, .0025);
    EXPECT_NEAR(order(coarse.pressure, fine.pressure), 2, .1);
    EXPECT_NEAR(order(coarse.excess, fine.excess), 2, .1);
  }
}

}  // namespace
}  // namespace bulbus
