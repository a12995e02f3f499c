#include "tests/unit/problem/standing_block.hpp"

namespace bulbus {
namespace {

TEST_F(FilledShell, HandOverFromGivenToCoupledLeavesTheResidualUnchanged) {
  Problem p(scene.mesh, scene.model, world());
  State s = at_end_of_step(p);
  s = shaken(p, s, .02, 3);
  const Residual before = p.residual(s);
  p.end_step();
  p.begin_step(1, s);
  p.set_progress(0, s);
  EXPECT_TRUE(p.liquids()[0].enclosed());
  const Residual after = p.residual(s);
  EXPECT_EQ(after.force, before.force);
  EXPECT_EQ(after.volume, before.volume);
  EXPECT_EQ(after.liquid[0], 0);
  EXPECT_DOUBLE_EQ(s.P[0], .05);
}

TEST_F(FilledShell, GivenPressureRampsFromStepToStepAndStays) {
  scene.model.steps[1].enclose.clear();
  scene.model.steps[1].pressures["fluid"] = "0.09";
  scene.model.steps.push_back(step("rest"));
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  const double expected[3][2] = {{.025, .05}, {.07, .09}, {.09, .09}};
  for (int k = 0; k < 3; ++k) {
    p.begin_step(k, s);
    for (int half : {0, 1}) {
      p.set_progress(.5 + .5 * half, s);
      EXPECT_DOUBLE_EQ(s.P[0], expected[k][half]);
    }
    p.end_step();
  }
}

// D = V − (V_i + ΔV s / multiplicity) + (P − P_i) V_i / K
TEST_F(FilledShell, AddedVolumeShiftsTheLaw) {
  scene.model.steps[1].add["fluid"] = .8;
  scene.model.steps.push_back(step("rest"));
  Problem p(scene.mesh, scene.model, world());
  EXPECT_EQ(p.multiplicity(), 8);
  State s = p.initial_state();
  p.begin_step(0, s), p.set_progress(1, s), p.end_step();
  p.begin_step(1, s);
  const double V = p.liquids()[0].volume(s.x);
  p.set_progress(.5, s);
  EXPECT_NEAR(p.residual(s).liquid[0], -.05, 1e-14);
  p.set_progress(1, s);
  EXPECT_NEAR(p.residual(s).liquid[0], -.1, 1e-14);
  s.P[0] += .3;
  EXPECT_NEAR(p.residual(s).liquid[0], -.1 + .3 * (V + .1) / 3, 1e-14);
  p.end_step();
  p.begin_step(2, s);
  p.set_progress(0, s);
  EXPECT_NEAR(p.residual(s).liquid[0], -.1 + .3 * (V + .1) / 3, 1e-14);
  p.set_progress(1, s);
  EXPECT_NEAR(p.residual(s).liquid[0], -.1 + .3 * (V + .1) / 3, 1e-14);
}

TEST_F(FilledShell, AddingToALiquidOfGivenPressureIsRefused) {
  scene.model.steps[0].add["fluid"] = 1;
  Problem p(scene.mesh, scene.model, world());
  EXPECT_THROW(p.begin_step(0, p.initial_state()), InputError);
}

TEST_F(FilledShell, UnknownLiquidsGetAGuess) {
  scene.model.steps[0].enclose = {"fluit"};
  Problem p(scene.mesh, scene.model, world());
  try {
    p.begin_step(0, p.initial_state());
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.key, "steps.0.enclose");
    EXPECT_NE(std::string(e.what()).find("'fluid'"), std::string::npos);
  }
}

TEST_F(FilledShell, VolumeIsThatOfTheCavity) {
  Problem p(scene.mesh, scene.model, world());
  const double V = p.liquids()[0].volume(p.initial_state().x);
  EXPECT_NEAR(V, 4.18879, .2);
  EXPECT_DOUBLE_EQ(p.liquids()[0].scale(), V);
}

TEST_F(FilledShell, LiquidOnTheWrongSideIsRefused) {
  scene.model.liquids["fluid"].surface = "outer";
  EXPECT_THROW(Problem(scene.mesh, scene.model, world()), InputError);
}

TEST_F(FilledShell, ResidualIsTheSameHoweverManyRanks) {
  Problem p(scene.mesh, scene.model, world());
  const Comm self(MPI_COMM_SELF);
  Problem alone(scene.mesh, scene.model, self);
  const auto state = [](Problem& q) {
    State s = q.initial_state();
    q.begin_step(0, s);
    q.set_progress(1, s);
    return shaken(q, s, .02, 3);
  };
  const State here = state(p), whole = state(alone);
  const Residual r = p.residual(here), expected = alone.residual(whole);
  std::vector<int> local_of(scene.mesh.points.size());
  for (int n = 0; n < alone.mesh().nodes(); ++n) local_of[alone.mesh().input_node[n]] = n;
  for (int n = 0; n < p.mesh().owned; ++n) {
    const int m = local_of[p.mesh().input_node[n]];
    for (int c = 0; c < 3; ++c) {
      ASSERT_NEAR(here.x[3 * n + c], whole.x[3 * m + c], 1e-14);
      ASSERT_NEAR(r.force[3 * n + c], expected.force[3 * m + c], 1e-13);
    }
    // a reference norm: at the seams of the ranks, |a + b| of a liquid's faces becomes |a| + |b|
    ASSERT_NEAR(r.reference_force[n], expected.reference_force[m], .02 * expected.reference_force[m]);
  }
  const EquilibriumError a = p.equilibrium_error(r), b = alone.equilibrium_error(expected);
  EXPECT_NEAR(a.force, b.force, .01 * b.force);
  EXPECT_EQ(a.region, b.region);
  EXPECT_NEAR(a.volume, b.volume, 1e-13);
}

}  // namespace
}  // namespace bulbus
