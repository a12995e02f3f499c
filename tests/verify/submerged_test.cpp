// An incompressible solid in a liquid under pressure feels nothing but that pressure.
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

class Submerged : public testing::TestWithParam<double> {};

/// Largest Mises stress and |λ + P| of the cells of a region, over P.
void expect_pressure_only(const Trial& run, const std::string& region, double P, const char* what) {
  const auto stresses = run.problem.solid().stresses(run.state.x, run.state.lambda);
  double mises = 0, pressure = 0;
  int cells = 0;
  for (const SolidRegion& r : run.problem.solid().regions())
    if (r.name == region)
      for (int h = r.first; h < r.first + r.count; ++h, ++cells) {
        mises = worse(mises, stresses[h].mises / P);
        pressure = worse(pressure, std::abs(run.state.lambda[h] + P) / P);
      }
  measured("{} at {} MPa: Mises stress / P {:.1e} (target 1e-10), |lambda + P| / P {:.1e} (target 1e-10)",
           what, P, mises, pressure);
  EXPECT_GT(cells, 0) << region;
  EXPECT_LT(mises, 1e-10);
  EXPECT_LT(pressure, 1e-10);
}

TEST_P(Submerged, FreeBall) {
  const double P = GetParam();
  for (bool direct : {true, false}) {
    Scene scene{generate(BallShape{.radius = 3, .n = 3, .layers = 3}), {}};
    scene.model.regions["ball"] = neo_hooke(.0833);
    scene.model.regions["ball"].c01 = .02;
    scene.model.symmetry = {"x", "y", "z"};
    StepSpec s = step("sink");
    LoadSpec load;
    load.surface = "outer", load.pressure = fmt::format("{:.17g}", P);
    s.loads.push_back(load);
    scene.model.steps.push_back(s);
    Trial run(scene);
    run.settings.newton = tight(1e-13);
    direct ? run.direct() : run.iterative();
    ASSERT_TRUE(run.report.converged) << run.report.reason;
    expect_pressure_only(run, "ball", P, direct ? "free ball, direct" : "free ball, iterative");
  }
}

/// A ball in the liquid of a vessel as stiff as the pressure needs: a wet surface of two parts, pressure
/// given and then enclosed with liquid added.
TEST_P(Submerged, BallInTheLiquidOfAVessel) {
  const double P = GetParam();
  for (bool direct : {true, false}) {
    Scene scene{generate(ShellShape{.inner = 5, .outer = 6, .n = 4, .layers = 2}), {}};
    Mesh ball = generate(BallShape{.radius = 3, .n = 2, .layers = 2});
    ball.surfaces = {{"skin", ball.surfaces.at("outer")}};
    append(scene.mesh, ball);
    auto& wet = scene.mesh.surfaces["wet"] = scene.mesh.surfaces.at("inner");
    const auto& skin = scene.mesh.surfaces.at("skin");
    wet.insert(wet.end(), skin.begin(), skin.end());
    Model& m = scene.model;
    m.regions = {{"shell", neo_hooke(20 * P)}, {"ball", neo_hooke(.0833)}};
    m.liquids["fluid"] = {.surface = "wet"};
    m.symmetry = {"x", "y", "z"};
    StepSpec fill = step("fill"), more = step("more");
    fill.pressures["fluid"] = fmt::format("{:.17g}", P);
    more.enclose = {"fluid"};
    more.add["fluid"] = 2;  // half a per cent of it
    m.steps = {fill, more};
    Trial run(scene);
    run.settings.newton = tight(1e-12);
    direct ? run.direct() : run.iterative();
    ASSERT_TRUE(run.report.converged) << run.report.reason;
    EXPECT_GT(run.state.P[0], 1.05 * P);
    expect_pressure_only(run, "ball", run.state.P[0],
                         direct ? "ball in a vessel, direct" : "ball in a vessel, iterative");
  }
}

INSTANTIATE_TEST_SUITE_P(Pressures, Submerged, testing::Values(.002, .02, .2, 2.));

}  // namespace
}  // namespace bulbus
