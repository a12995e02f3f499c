#include "core/solve/march.hpp"

#include <gtest/gtest.h>

#include "tests/support/not_empty.hpp"
#include "tests/unit/solve/trial.hpp"

namespace bulbus {
namespace {

using namespace test;

TEST(March, UniaxialStretchHasTheExactNominalStress) {
  for (double dz : {.4, -.3}) {
    Trial run(stretched_block(2, std::to_string(dz)));
    run.go();
    ASSERT_TRUE(run.report.converged) << run.report.reason;
    const double l = 1 + dz, expected = 2 * .5 * (l - 1 / (l * l));
    EXPECT_NEAR(run.reaction("zmax", 2), expected, 1e-9);
    const double side = 1 / std::sqrt(l);
    const auto nodes = run.nodes("xmax");
    EXPECT_GT(run.comm.sum(static_cast<int>(nodes.size())), 0);
    for (int n : nodes) EXPECT_NEAR(run.state.x[3 * n], side, 1e-9);
    for (double lambda : run.state.lambda)  // no stress across: τ_xx = 2 c10 (b − tr b / 3), λ = −τ_xx
      EXPECT_NEAR(lambda, -((1 / l) - (l * l + 2 / l) / 3), 1e-9);
  }
}

TEST(March, GammaDoesNotMatterToTheDirectSolver) {
  Trial plain(stretched_block(2, "0.4")), augmented(stretched_block(2, "0.4"));
  plain.go(0), augmented.go(10);
  ASSERT_TRUE(augmented.report.converged);
  EXPECT_EQ(augmented.report.newton_iterations, plain.report.newton_iterations);
  EXPECT_NEAR(augmented.reaction("zmax", 2), plain.reaction("zmax", 2), 1e-10);
}

TEST(March, ConvergesQuadratically) {
  for (const char* what : {"stretch", "inflation"}) {
    Trial run(what == std::string("stretch") ? stretched_block(2, "0.4") : inflated_shell());
    run.go();
    ASSERT_TRUE(run.report.converged) << run.report.reason;
    EXPECT_EQ(run.report.cuts, 0);
    for (const Increment& i : not_empty(run.increments)) {
      expect_quadratic(i.newton);
      EXPECT_LE(i.newton.iterations.size(), 8u);
    }
  }
}

TEST(March, RigidBodiesSkewHoldsBarsAndLiquidConvergeQuadraticallyToo) {
  Scene scene = filled_shell("half");
  scene.mesh.node_sets["seat"] = nodes_where(scene.mesh, [](const Point& p) { return p[2] < -.9 * norm(p); });
  scene.model.fix.push_back({"seat", {"y", "z"}});
  Trial run(scene);
  run.go();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  for (const Increment& i : run.increments) expect_quadratic(i.newton);
  EXPECT_LT(run.increments.back().newton.error.force, 1e-10);
}

TEST(March, NegativePivotsAreHexahedraAndLiquids) {
  Trial run(inflated_shell());
  run.go();
  ASSERT_EQ(run.increments.size(), 2u);
  for (const Increment& i : not_empty(run.increments))
    EXPECT_EQ(i.newton.negative_pivots, run.problem.mesh().all_hexes + 1);
  Trial stretch(stretched_block(2, "0.4"));
  EXPECT_EQ(stretch.go().increments.back().newton.negative_pivots, 8);
}

// Elimination is exact: iterates, pivots and answers are those of the bordered system up to round-off.
TEST(March, EliminatedPressureGivesTheSameAnswerByTheSameIterations) {
  Trial bordered(inflated_shell()), eliminated(inflated_shell());
  eliminated.settings.linear.formulation = Formulation::eliminated;
  bordered.go(), eliminated.go();
  ASSERT_TRUE(eliminated.report.converged) << eliminated.report.reason;
  EXPECT_EQ(eliminated.report.newton_iterations, bordered.report.newton_iterations);
  ASSERT_EQ(eliminated.increments.size(), bordered.increments.size());
  for (std::size_t i = 0; i < eliminated.increments.size(); ++i)
    EXPECT_EQ(eliminated.increments[i].newton.negative_pivots, bordered.increments[i].newton.negative_pivots);
  EXPECT_LT(relative_difference(eliminated.state.x, bordered.state.x), 1e-11);
  EXPECT_LT(relative_difference(eliminated.state.P, bordered.state.P), 1e-11);
}

TEST(March, ReportsTheFactors) {
  for (const Formulation formulation : {Formulation::bordered, Formulation::eliminated}) {
    Trial run(inflated_shell());
    run.settings.linear.formulation = formulation;
    run.go();
    const auto& factor = run.increments.back().newton.iterations.back().linear.factor;
    ASSERT_TRUE(factor);
    EXPECT_GT(factor->matrix_entries, 1000);
    EXPECT_GT(factor->factor_entries, factor->matrix_entries);
    EXPECT_GT(factor->flops, 1e5);
    EXPECT_EQ(factor->negative_pivots, run.increments.back().newton.negative_pivots);
  }
}

TEST(March, EnclosedLiquidObeysItsLaw) {
  Trial run(inflated_shell());
  run.go();
  ASSERT_TRUE(run.report.converged);
  const double P = run.state.P[0], V = run.problem.liquids()[0].volume(run.state.x);
  EXPECT_GT(P, .05);
  EXPECT_NEAR(run.problem.residual(run.state).liquid[0], 0, 1e-9 * V);
}

TEST(March, ReportsWhatItDid) {
  Scene scene = stretched_block(2, "0.4");
  scene.model.steps[0].increments = 4;
  scene.model.steps.push_back(step("rest"));
  Trial run(scene);
  run.go();
  EXPECT_TRUE(run.report.converged);
  EXPECT_EQ(run.report.increments, 5);
  ASSERT_EQ(run.increments.size(), 5u);
  EXPECT_EQ(run.increments[2].number, 3);
  EXPECT_EQ(run.increments[2].step_name, "stretch");
  EXPECT_NEAR(run.increments[2].progress, .75, 1e-14);
  EXPECT_EQ(run.increments[3].progress, 1);
  EXPECT_EQ(run.increments[4].time, 2);
  EXPECT_EQ(run.increments[4].newton.iterations.size(), 0u);  // already there
  int iterations = 0;
  for (const auto& i : run.increments) iterations += static_cast<int>(i.newton.iterations.size());
  EXPECT_EQ(run.report.newton_iterations, iterations);
}

TEST(March, ScalesTheIncrementsOfEveryStep) {
  Scene scene = stretched_block(2, "0.4");
  scene.model.steps[0].increments = 4;
  for (const auto& [factor, increments] : {std::pair{.25, 1}, {.3, 2}, {.5, 2}, {1., 4}, {2., 8}}) {
    Trial run(scene);
    run.settings.stepping.increments = factor;
    EXPECT_EQ(run.go().report.increments, increments) << factor;
  }
}

TEST(March, IsLaxUnderwayAndStrictAtTheEnd) {
  Scene scene = stretched_block(2, "0.4");
  scene.model.steps[0].increments = 4;
  Trial strict(scene), lax(scene);
  lax.settings.newton.intermediate = 1e6;
  strict.go(), lax.go();
  EXPECT_LT(lax.report.newton_iterations, strict.report.newton_iterations);
  for (int i = 0; i < 4; ++i) {
    const EquilibriumError &left = lax.increments[i].newton.error, &right = strict.increments[i].newton.error;
    EXPECT_LE(std::max(right.force, right.volume), 1e-10);
    EXPECT_EQ(std::max(left.force, left.volume) > 1e-10, i < 3) << i;
  }
  EXPECT_NEAR(lax.reaction("zmax", 2), strict.reaction("zmax", 2), 1e-9);
}

TEST(March, DeadLoadReachesItsEquilibrium) {
  Scene scene = stretched_block(2, "0");
  scene.model.steps[0].displace.clear();
  LoadSpec pull;
  pull.surface = "zmax", pull.pressure = "-0.5", pull.dead = true;
  scene.model.steps[0].loads.push_back(pull);
  Trial run(scene);
  run.go();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  const auto top = run.nodes("zmax");
  if (top.empty()) return;
  const double l = run.state.x[3 * top[0] + 2];
  EXPECT_NEAR(l - 1 / (l * l), .5, 1e-8);  // nominal stress
}

TEST(March, FollowerPressureReachesItsEquilibriumAlthoughUnsymmetric) {
  Scene scene = stretched_block(2, "0");
  scene.model.steps[0].displace.clear();
  LoadSpec pull;
  pull.surface = "zmax", pull.pressure = "-0.5";
  scene.model.steps[0].loads.push_back(pull);
  Trial run(scene);
  run.go();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  for (const Increment& i : not_empty(run.increments)) {
    expect_quadratic(i.newton);
    EXPECT_EQ(i.newton.negative_pivots, -1);
  }
  const auto top = run.nodes("zmax");
  if (top.empty()) return;
  const double l = run.state.x[3 * top[0] + 2];
  EXPECT_NEAR(l * l - 1 / l, .5, 1e-8);  // Cauchy stress
}

TEST(March, RigidLidTurnsUnderACouple) {
  Scene scene{generate(BlockShape{.upper = {2, 1, 3}, .nx = 2, .ny = 2, .nz = 3}), {}};
  split_region(scene.mesh, "lid", [](const Point& p) { return p[2] > 2; });
  scene.model.regions = {{"block", neo_hooke(.5)}, {"lid", rigid()}};
  scene.model.fix.push_back({"zmin", {"x", "y", "z"}});
  scene.mesh.node_sets["left"] =
      nodes_where(scene.mesh, [](const Point& p) { return p[2] == 3 && p[0] == 0; });
  scene.mesh.node_sets["right"] =
      nodes_where(scene.mesh, [](const Point& p) { return p[2] == 3 && p[0] == 2; });
  StepSpec s = step("turn");
  LoadSpec up, down;
  up.set = "left", up.force = Point{0, 0, .03};
  down.set = "right", down.force = Point{0, 0, -.03};
  s.loads = {up, down};
  scene.model.steps = {s};
  Trial run(scene);
  run.go();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  expect_quadratic(run.increments.back().newton);
  EXPECT_GT(run.state.bodies[0].rotation(0, 2), .01);  // the left rises: z leans to +x
  EXPECT_NEAR(norm(run.problem.residual(run.state).bodies[0].moment), 0, 1e-9);
}

TEST(March, ResultsAreTheSameHoweverManyRanks) {
  Trial run(filled_shell("octant")), alone(filled_shell("octant"), Comm(MPI_COMM_SELF));
  run.go(), alone.go();
  ASSERT_TRUE(run.report.converged && alone.report.converged);
  EXPECT_NEAR(run.state.P[0], alone.state.P[0], 1e-9);
  std::vector<int> local_of(alone.problem.mesh().nodes());
  for (int n = 0; n < alone.problem.mesh().nodes(); ++n) local_of[alone.problem.mesh().input_node[n]] = n;
  for (int n = 0; n < run.problem.mesh().nodes(); ++n)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(run.state.x[3 * n + c], alone.state.x[3 * local_of[run.problem.mesh().input_node[n]] + c],
                  1e-8);
}

}  // namespace
}  // namespace bulbus
