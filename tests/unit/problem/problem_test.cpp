#include "core/problem/problem.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/support/models.hpp"

namespace bulbus {
namespace {

Comm world() { return {}; }

/// Sum of the nodal forces of all ranks.
Vec3<double> total(const Problem& p, const State& s) {
  std::vector<double> sum(3);
  const Residual r = p.residual(s);
  for (int i = 0; i < 3 * p.mesh().owned; ++i) sum[i % 3] += r.force[i];
  world().sum(sum);
  return {sum[0], sum[1], sum[2]};
}

void expect_near(const Vec3<double>& a, const Vec3<double>& b, double tolerance = 1e-13) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << c;
}

/// A 2 × 1 × 3 block on a fixed bottom.
Scene standing_block() {
  Scene s{generate(BlockShape{.upper = {2, 1, 3}, .nx = 2, .ny = 2, .nz = 3}), {}};
  s.model.regions["block"] = neo_hooke(.5);
  s.model.fix.push_back({"zmin", {"x", "y", "z"}});
  s.model.steps = {step("one")};
  return s;
}

LoadSpec pressure(const std::string& surface, const std::string& p, bool dead = false) {
  LoadSpec l;
  l.surface = surface, l.pressure = p, l.dead = dead;
  return l;
}

LoadSpec force(const std::string& set, const Point& f) {
  LoadSpec l;
  l.set = set, l.force = f;
  return l;
}

/// The state with nodes stretched by s about the origin; no stresses count since λ = 0 and forces of the solid are subtracted.
Vec3<double> load_only(const Problem& p, const State& s) {
  Vec3<double> all = total(p, s);
  std::vector<double> f(s.x.size()), v(s.lambda.size()), own(3);
  p.solid().residual(s.x, s.lambda, f, v);
  for (std::size_t i = 0; i < f.size(); ++i) own[i % 3] += f[i];  // every rank's share
  world().sum(own);
  for (int c = 0; c < 3; ++c) all[c] -= own[c];
  return all;
}

State stretched(const Problem& p, double sx) {
  State s = p.initial_state();
  for (int n = 0; n < p.mesh().nodes(); ++n) s.x[3 * n] *= sx;
  return s;
}

TEST(Loads, DeadPressurePushesAgainstTheReferenceNormal) {
  Scene scene = standing_block();
  scene.model.steps[0].loads.push_back(pressure("zmax", "0.2", true));
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s);
  p.set_progress(.5, s);
  expect_near(load_only(p, s), {0, 0, .1 * 2});  // residual: minus the load
  expect_near(load_only(p, stretched(p, 1.5)), {0, 0, .1 * 2});
}

TEST(Loads, DeadPressureAlongAGivenDirection) {
  Scene scene = standing_block();
  scene.model.steps[0].loads.push_back(pressure("zmax", "0.2", true));
  scene.model.steps[0].loads[0].direction = {3, 0, 4};
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s);
  p.set_progress(1, s);
  expect_near(load_only(p, s), {-.2 * 2 * .6, 0, -.2 * 2 * .8});
}

TEST(Loads, FollowerPressureFollowsTheArea) {
  Scene scene = standing_block();
  scene.model.steps[0].loads.push_back(pressure("zmax", "0.2"));
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s);
  p.set_progress(1, s);
  expect_near(load_only(p, s), {0, 0, .4});
  expect_near(load_only(p, stretched(p, 1.5)), {0, 0, .6});
  EXPECT_FALSE(p.symmetric());
}

TEST(Loads, FollowerPressureTurnsWithTheFace) {
  Scene scene = standing_block();
  scene.model.steps[0].loads.push_back(pressure("zmax", "0.2"));
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s);
  p.set_progress(1, s);
  for (int n = 0; n < p.mesh().nodes(); ++n) {  // z to x, x to −z
    const double x = s.x[3 * n], z = s.x[3 * n + 2];
    s.x[3 * n] = z, s.x[3 * n + 2] = -x;
  }
  expect_near(load_only(p, s), {.4, 0, 0});
}

TEST(Loads, FormulasAreTakenAsTheyStand) {
  Scene scene = standing_block();
  scene.model.steps = {step("one"), step("two")};
  scene.model.steps[1].loads.push_back(pressure("zmax", "s^2 + 10 * t", true));
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s), p.end_step(), p.begin_step(1, s);
  p.set_progress(.5, s);
  expect_near(load_only(p, s), {0, 0, 2 * (.25 + 15)});
}

TEST(Loads, PressuresRampFromStepToStepAndStay) {
  Scene scene = standing_block();
  scene.model.steps = {step("one"), step("two"), step("three"), step("four")};
  scene.model.steps[0].loads.push_back(pressure("zmax", "0.2", true));
  scene.model.steps[1].loads.push_back(pressure("zmax", "0.6", true));
  scene.model.steps[3].release = {"zmax"};
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  const double expected[4][2] = {{.1, .2}, {.4, .6}, {.6, .6}, {0, 0}};
  for (int k = 0; k < 4; ++k) {
    p.begin_step(k, s);
    for (int half : {0, 1}) {
      p.set_progress(.5 + .5 * half, s);
      expect_near(load_only(p, s), {0, 0, 2 * expected[k][half]});
    }
    p.end_step();
  }
}

TEST(Loads, NodalForcesRampFromStepToStepAndStay) {
  Scene scene = standing_block();
  scene.model.steps = {step("one"), step("two"), step("three"), step("four")};
  scene.model.steps[0].loads.push_back(force("zmax", {0, 0, 1}));
  scene.model.steps[1].loads.push_back(force("zmax", {2, 0, 3}));
  scene.model.steps[3].release = {"zmax"};
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  const Vec3<double> expected[4][3] = {{{0, 0, 0}, {0, 0, .5}, {0, 0, 1}}, {{0, 0, 1}, {1, 0, 2}, {2, 0, 3}}, {{2, 0, 3}, {2, 0, 3}, {2, 0, 3}}, {}};
  for (int k = 0; k < 4; ++k) {
    p.begin_step(k, s);
    for (int i : {0, 1, 2}) {
      p.set_progress(.5 * i, s);
      Vec3<double> f = expected[k][i];
      for (double& c : f) c *= -9;  // nodes of zmax
      expect_near(load_only(p, s), f);
    }
    p.end_step();
  }
}

TEST(Loads, LoadsOfBothKindsAdd) {
  Scene scene = standing_block();
  scene.model.steps[0].loads = {pressure("zmax", "0.2", true), force("zmax", {1, 0, 0}), pressure("xmax", "0.1")};
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s);
  p.set_progress(1, s);
  expect_near(load_only(p, s), {-9 + .1 * 3, 0, .4});
}

TEST(Release, OfNothingIsAnError) {
  Scene scene = standing_block();
  scene.model.steps[0].release = {"zmax"};
  Problem p(scene.mesh, scene.model, world());
  const State s = p.initial_state();
  try {
    p.begin_step(0, s);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.key, "steps.0.release");
  }
}

TEST(ProblemSets, UnnamedOnesAreRefused) {
  const Scene scene = stretched_block(1, "0.1");
  Problem p(scene.mesh, scene.model, world());
  EXPECT_FALSE(p.nodes_of("zmax").empty());
  EXPECT_THROW(p.nodes_of("outside"), InputError);
}

// ---- prescribed displacements: where the defect leads to ----

State obeyed(const Problem& p, State s, double progress) {
  std::vector<double> du(s.x.size());
  p.dofs().defect(s, progress, du);
  s.x = plus(s.x, 1, du);
  return s;
}

struct Displaced : testing::Test {
  Scene scene = standing_block();
  DisplaceSpec d = displace("zmax");
  // expects every zmax node, from `start`, at `place(X, x)`
  template <class Place>
  void expect_places(double progress, Place place, bool from_reference = false) {
    scene.model.steps[0].displace = {d};
    Problem p(scene.mesh, scene.model, world());
    State start = from_reference ? p.initial_state() : moved(p, p.initial_state(), noise_primal(p, 1), .05);
    p.begin_step(0, start);
    p.set_progress(progress, start);
    const State end = obeyed(p, start, progress);
    for (int n : p.nodes_of("zmax")) {
      const auto at = [n](std::span<const double> v) { return Vec3<double>{v[3 * n], v[3 * n + 1], v[3 * n + 2]}; };
      expect_near(at(end.x), place(at(p.mesh().X), at(start.x)), 1e-13);
    }
  }
};

TEST_F(Displaced, NumbersAreReachedLinearlyFromWhereTheStepStarts) {
  d.z = "0.5";
  expect_places(.25, [](auto X, auto x) { return Vec3<double>{x[0], x[1], x[2] + .25 * (X[2] + .5 - x[2])}; });
}

TEST_F(Displaced, NumbersCountFromTheStartIfAsked) {
  d.z = "0.5", d.from = "start";
  expect_places(.25, [](auto, auto x) { return Vec3<double>{x[0], x[1], x[2] + .125}; });
}

TEST_F(Displaced, FormulasKnowThePlace) {
  d.x = "X*s + t", d.y = "0.1*Z*Y";
  expect_places(.5, [](auto X, auto x) { return Vec3<double>{X[0] + X[0] * .5 + .5, X[1] + .3 * X[1], x[2]}; });
}

TEST_F(Displaced, AlongADirectionOfItsOwn) {
  d.by = "0.5", d.along = {0, 3, 4};
  expect_places(1, [](auto X, auto x) {
    const double along = .6 * (x[1] - X[1]) + .8 * (x[2] - X[2]);
    return Vec3<double>{x[0], x[1] + .6 * (.5 - along), x[2] + .8 * (.5 - along)};
  });
}

TEST_F(Displaced, RadiallyFromAnAxis) {
  d.radial = "0.5", d.axis = {0, 0, 2}, d.center = {-1, -1, 0};
  expect_places(1, [](auto X, auto x) {
    const double r = std::hypot(X[0] + 1, X[1] + 1), k = (r + .5) / r;
    return Vec3<double>{-1 + k * (X[0] + 1), -1 + k * (X[1] + 1), x[2]};
  }, true);
}

TEST_F(Displaced, NodeOnTheRadialAxisIsRefused) {
  d.radial = "0.5";
  scene.model.steps[0].displace = {d};
  Problem p(scene.mesh, scene.model, Comm(MPI_COMM_SELF));
  EXPECT_THROW(p.begin_step(0, p.initial_state()), InputError);
}

TEST_F(Displaced, AffineFromTheReference) {
  d.affine = std::vector<double>{1.2, .1, 0, 0, .9, 0, .3, 0, 1};
  expect_places(1, [](auto X, auto) { return Vec3<double>{1.2 * X[0] + .1 * X[1], .9 * X[1], .3 * X[0] + X[2]}; });
}

TEST_F(Displaced, RotationAndTranslationFromTheStart) {
  d.rotate = DisplaceSpec::Rotation{{0, 0, 5}, {1, .5, 0}, 1.0};
  d.translate = Point{0, 0, .4};
  expect_places(.5, [](auto, auto x) {
    const double c = std::cos(.5), s = std::sin(.5), a = x[0] - 1, b = x[1] - .5;
    return Vec3<double>{1 + c * a - s * b, .5 + s * a + c * b, x[2] + .2};
  });
}

TEST(Displacements, LastOneReplacesTheSameOfAnEarlierStepAndTheOthersStay) {
  Scene scene = standing_block();
  scene.model.steps = {step("one"), step("two"), step("three")};
  DisplaceSpec d = displace("zmax");
  d.x = "0.1", d.z = "0.3";
  scene.model.steps[0].displace = {d};
  d.x.reset(), d.z = "0.5";
  scene.model.steps[1].displace = {d};
  scene.model.steps[2].release = {"zmax"};
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s), p.set_progress(1, s);
  s = obeyed(p, s, 1);
  p.end_step(), p.begin_step(1, s), p.set_progress(.5, s);
  s = obeyed(p, s, .5);
  for (int n : p.nodes_of("zmax")) {
    EXPECT_NEAR(s.x[3 * n] - p.mesh().X[3 * n], .1, 1e-14);
    EXPECT_NEAR(s.x[3 * n + 2] - p.mesh().X[3 * n + 2], .4, 1e-14);
  }
  p.end_step(), p.begin_step(2, s);
  for (int n : p.nodes_of("zmax")) EXPECT_FALSE(p.dofs().held(n));
}

TEST(Displacements, ElementsWithoutAFreeNodeAreRefused) {
  Scene scene = standing_block();
  DisplaceSpec d = displace("block");
  d.x = d.y = d.z = "0";
  scene.model.steps[0].displace = {d};
  Problem p(scene.mesh, scene.model, world());
  try {
    p.begin_step(0, p.initial_state());
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.key, "steps.0");
    EXPECT_NE(std::string(e.what()).find("over-constrained"), std::string::npos);
  }
}

// ---- liquids ----

struct FilledShell : testing::Test {
  Scene scene = filled_shell("octant");
};

TEST_F(FilledShell, HandOverFromGivenToCoupledLeavesTheResidualUnchanged) {
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s);
  p.set_progress(1, s);
  s = shaken(p, s, .02, 3);
  const Residual before = p.residual(s);
  p.end_step();
  p.begin_step(1, s);
  p.set_progress(0, s);
  EXPECT_TRUE(p.liquids()[0].coupled());
  const Residual after = p.residual(s);
  EXPECT_EQ(after.force, before.force);
  EXPECT_EQ(after.volume, before.volume);
  EXPECT_EQ(after.liquid[0], 0);
  EXPECT_DOUBLE_EQ(s.P[0], .05);
}

TEST_F(FilledShell, GivenPressureRampsFromStepToStepAndStays) {
  scene.model.steps[1].couple.clear();
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
  scene.model.steps[0].couple = {"fluit"};
  Problem p(scene.mesh, scene.model, world());
  try {
    p.begin_step(0, p.initial_state());
    FAIL();
  } catch (const InputError& e) {
    EXPECT_EQ(e.key, "steps.0.couple");
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
    // a yardstick: at the seams of the ranks, |a + b| of a liquid's faces becomes |a| + |b|
    ASSERT_NEAR(r.magnitude[n], expected.magnitude[m], .02 * expected.magnitude[m]);
  }
  const Balance a = p.balance(r), b = alone.balance(expected);
  EXPECT_NEAR(a.force, b.force, .01 * b.force);
  EXPECT_EQ(a.region, b.region);
  EXPECT_NEAR(a.volume, b.volume, 1e-13);
}

// ---- rigid regions ----

TEST_F(FilledShell, RigidHexahedraKeepTheirVolumeInTheBalance) {
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s);
  const Balance b = p.balance(p.residual(s));
  EXPECT_LT(b.volume, 1e-13);
  s = shaken(p, s, .02, 3);
  const Residual r = p.residual(s);
  double worst = 0;
  for (std::size_t e = 0; e < r.volume.size(); ++e) worst = std::max(worst, std::abs(r.volume[e]) / p.solid().reference_volumes()[e]);
  EXPECT_DOUBLE_EQ(p.balance(r).volume, world().max(worst));
  EXPECT_GT(worst, 1e-4);
}

TEST(RigidRegions, AreHeldOnlyByThePlanesThatCutThem) {
  // A quarter model (x, y >= 0) of two blocks: one at the corner, one beside the plane y = 0 but on x = 0.
  Scene s{generate(BlockShape{.nx = 2, .ny = 1, .nz = 1, .region = "soft"}), {}};
  Mesh hard = generate(BlockShape{.lower = {0, 2, 0}, .upper = {1, 3, 1}, .region = "hard"});
  hard.surfaces = {{"hard_top", hard.surfaces.at("zmax")}};
  append(s.mesh, hard);
  s.model.regions = {{"soft", neo_hooke(1)}, {"hard", rigid()}};
  s.model.symmetry = {"x", "y"};
  s.model.fix.push_back({"zmin", {"z"}});
  for (int n : {4, 5, 10, 11})  // to the soft block, inclined, so that nothing is left free
    for (int m = 0; m < 8; ++m) s.mesh.bars["ties"].push_back({at_node(n), at_node(12 + m)});
  s.model.bars["ties"] = {};
  s.model.steps = {step("only")};
  const Problem p(s.mesh, s.model, world());
  EXPECT_EQ(p.dofs().bodies()[0].free(), (std::array<bool, 6>{false, true, true, true, false, false}));
}

TEST(RigidRegions, BalanceCountsTheResultantOnABody) {
  Scene scene = standing_block();
  split_region(scene.mesh, "lid", [](const Point& p) { return p[2] > 2; });
  scene.model.regions["lid"] = rigid();
  scene.model.steps[0].loads.push_back(force("zmax", {0, 0, 1}));
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s);
  p.set_progress(1, s);
  const Balance b = p.balance(p.residual(s));
  EXPECT_EQ(b.region, "lid");
  EXPECT_DOUBLE_EQ(b.force, 1);
}

TEST(RigidRegions, BalanceCountsTheMomentOnABody) {
  Scene scene = standing_block();
  split_region(scene.mesh, "lid", [](const Point& p) { return p[2] > 2; });
  scene.model.regions["lid"] = rigid();
  scene.mesh.node_sets["left"] = nodes_where(scene.mesh, [](const Point& p) { return p[2] == 3 && p[0] == 0; });
  scene.mesh.node_sets["right"] = nodes_where(scene.mesh, [](const Point& p) { return p[2] == 3 && p[0] == 2; });
  scene.model.steps[0].loads = {force("left", {0, 0, 1}), force("right", {0, 0, -1})};
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s);
  p.set_progress(1, s);
  const Residual r = p.residual(s);
  EXPECT_NEAR(norm(r.bodies[0].force), 0, 1e-14);
  expect_near(r.bodies[0].moment, {0, -6, 0});
  EXPECT_EQ(p.balance(r).region, "lid");
  EXPECT_GT(p.balance(r).force, .5);
}

}  // namespace
}  // namespace bulbus
