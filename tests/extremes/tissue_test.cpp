// Tissues of very different stiffness, thin layers, long cells, flat cells, large stretches.
#include "core/base/error.hpp"
#include "core/mesh/quality.hpp"
#include "tests/extremes/spheres.hpp"

namespace bulbus {
namespace {

/// An octant with a cap at its pole: of a tissue so many times as stiff, or (0) rigid.
Scene capped(double contrast) {
  Scene scene = filled_layers(4, 2, {{10, 12, .0833}}, .1, 2083.3, 2);
  split_region(scene.mesh, "cap", [](const Point& p) { return p[2] > .86 * norm(p); });
  scene.model.regions["cap"] = contrast > 0 ? neo_hooke(.0833 * contrast) : rigid();
  return scene;
}

TEST(Tissue, AStiffPartTendsToARigidOne) {
  Trial rigid_cap(capped(0));
  rigid_cap.settings.newton = close_balance();
  rigid_cap.direct();
  ASSERT_TRUE(rigid_cap.report.converged) << rigid_cap.report.reason;
  for (double contrast : {1e-8, 1e-4, 1., 1e2, 1e4, 1e6, 1e8}) {
    BothSolvers both(capped(contrast), NewtonSettings{});
    const double p = both.run.state.P[0], off = relative(p, rigid_cap.state.P[0]);
    row("stiffness contrast, part of a wall", fmt::format("{:g}", contrast), both.run,
        "P {:.4g} MPa, {:.0e} from that with a rigid part; {}", p, off, both.compared());
    ASSERT_TRUE(both.both()) << both.run.report.reason;
    if (contrast >= 1e4) {
      EXPECT_LT(off, 10 / contrast + 1e-5);
    }
    EXPECT_LT(both.apart().places, 1e-4);
    EXPECT_LT(both.apart().pressures, 1e-3);
  }
}

TEST(Tissue, LayersOfVeryDifferentStiffness) {
  for (double contrast : {1e-8, 1e-4, 1e4, 1e8}) {
    const std::vector<ShellLayer> layers{{10, 11, .0833 * contrast}, {11, 12, .0833}};
    BothSolvers both(filled_layers(4, 1, layers, .1, 2083.3, 2));
    const double exact = pressure_of(layers, stretch_of(both.run)), dp = relative(both.run.state.P[0], exact);
    row("stiffness contrast, inner layer", fmt::format("{:g}", contrast), both.run,
        "P off by {:.1e} of the closed form", dp);
    ASSERT_TRUE(both.both()) << both.run.report.reason;
    EXPECT_LT(dp, .01);
    EXPECT_LT(relative(both.run.state.P[0], both.oracle.state.P[0]), 1e-5);
  }
}

TEST(Tissue, LayersDownToAMicrometre) {
  for (double t : {.2, .02, .005, .001}) {
    const std::vector<ShellLayer> layers{
        {11.3, 11.3 + t, .0008}, {11.3 + t, 11.5 + t, .0083}, {11.5 + t, 12.3, .0833}};
    BothSolvers both(filled_layers(6, 1, layers, .1, 2083.3, 2));
    const double exact = pressure_of(layers, stretch_of(both.run)), dp = relative(both.run.state.P[0], exact);
    row("thickness of the inner layer", fmt::format("{:g} um", 1000 * t), both.run,
        "P off by {:.1e} of the closed form; {}; aspect {:.0f}", dp, both.compared(),
        11.3 * M_PI / 4 / 6 / t);
    ASSERT_TRUE(both.both()) << both.run.report.reason;
    EXPECT_LT(dp, .01);
    EXPECT_LT(both.apart().places, 1e-5);
    EXPECT_LT(both.apart().pressures, 1e-4);
  }
}

/// Did MUMPS solve systems in place of GMRES?
bool solved_by_fallback(const Trial& run) {
  return std::ranges::any_of(run.increments, [](const Increment& i) { return i.newton.direct_solves > 0; });
}

TEST(Tissue, CellsOfLargeAspect) {
  for (bool apart : {false, true})
    for (double aspect : {1., 5., 10., 50., 500.}) {
      BothSolvers both(glued_slab(aspect, apart));
      row(apart ? "aspect, glued slab pulled" : "aspect, glued slab sheared", fmt::format("{:g}", aspect),
          both.run, "{}{}", both.compared(), both.stable() ? "" : "; not stable");
      ASSERT_TRUE(both.both()) << both.run.report.reason << both.oracle.report.reason;
      EXPECT_LT(both.apart().places, 1e-5);
      EXPECT_LT(both.apart().pressures, 1e-3);
      EXPECT_LT(most_krylov(both.run), 120);
      EXPECT_EQ(both.run.report.cuts, 0);
      const bool stable = !apart || aspect < 10;
      EXPECT_EQ(both.stable(), stable);
      EXPECT_TRUE(stable || solved_by_fallback(both.run));
    }
}

TEST(Tissue, StretchesUpToFive) {
  for (double l : {5., 2., .5, .2}) {
    Trial run(stretched_block(3, fmt::format("{:.17g}", l - 1)));
    run.settings.newton = close_balance();
    run.iterative();
    ASSERT_TRUE(run.report.converged) << run.report.reason;
    expect_clean(run);
    const double stress = run.virial()(2, 2), off = relative(stress, l - 1 / (l * l));
    row("stretch in one increment", fmt::format("{:g}", l), run,
        "nominal stress off by {:.0e} of the closed form", off);
    EXPECT_LT(off, 1e-6);
  }
}

/// A block one node of which comes so near to the plane of its three neighbours in a cell that the cell's
/// scaled Jacobian there is `flat`.
Scene flattened(double flat) {
  Scene scene = stretched_block(3, "0.5");
  const int node = nodes_where(scene.mesh, [](const Point& p) {
                     return norm({p[0] - 1. / 3, p[1] - 1. / 3, p[2] - 1. / 3}) < 1e-9;
                   }).front();
  const auto least = [&](double q) {
    scene.mesh.points[node] = {q, q, q};
    return quality(scene.mesh)[0].least;
  };
  double low = .1, high = 1. / 3;
  for (int i = 0; i < 60; ++i) (least((low + high) / 2) < flat ? low : high) = (low + high) / 2;
  least(high);
  return scene;
}

TEST(Tissue, CellsThatAreNearlyFlat) {
  for (double flat : {.1, .01, 1e-4, 1e-8}) {
    const Scene scene = flattened(flat);
    refuse_inverted(scene.mesh);
    Trial run(scene);
    run.settings.newton = close_balance();
    run.iterative();
    expect_clean(run);
    ASSERT_TRUE(run.report.converged) << run.report.reason;
    const double off = relative(run.virial()(2, 2), 1.5 - 1 / 2.25);
    row("scaled Jacobian of a cell", fmt::format("{:g}", flat), run,
        "nominal stress off by {:.0e} of the closed form", off);
    EXPECT_LT(off, 1e-6);
  }
  EXPECT_THROW(refuse_inverted(flattened(-1e-3).mesh), InputError);
}

}  // namespace
}  // namespace bulbus
