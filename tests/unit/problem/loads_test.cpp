#include "tests/support/two_regions.hpp"
#include "tests/unit/problem/standing_block.hpp"

namespace bulbus {
namespace {

/// Sum of the nodal forces of all ranks.
Vec3<double> total(const Problem& p, const State& s) {
  std::vector<double> sum(3);
  const Residual r = p.residual(s);
  for (int i = 0; i < 3 * p.mesh().owned; ++i) sum[i % 3] += r.force[i];
  world().sum(sum);
  return {sum[0], sum[1], sum[2]};
}

LoadSpec pressure(const std::string& surface, const std::string& p, bool dead = false) {
  LoadSpec l;
  l.surface = surface, l.pressure = p, l.dead = dead;
  return l;
}

/// The state with nodes stretched by s about the origin; no stresses count since λ = 0 and forces of the
/// solid are subtracted.
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
  State s = at_end_of_step(p);
  expect_near(load_only(p, s), {-.2 * 2 * .6, 0, -.2 * 2 * .8});
}

TEST(Loads, FollowerPressureFollowsTheArea) {
  Scene scene = standing_block();
  scene.model.steps[0].loads.push_back(pressure("zmax", "0.2"));
  Problem p(scene.mesh, scene.model, world());
  State s = at_end_of_step(p);
  expect_near(load_only(p, s), {0, 0, .4});
  expect_near(load_only(p, stretched(p, 1.5)), {0, 0, .6});
  EXPECT_FALSE(p.symmetric());
}

TEST(Loads, FollowerPressureTurnsWithTheFace) {
  Scene scene = standing_block();
  scene.model.steps[0].loads.push_back(pressure("zmax", "0.2"));
  Problem p(scene.mesh, scene.model, world());
  State s = at_end_of_step(p);
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

TEST(Loads, OfARegionPushIntoIt) {
  for (const auto& [region, sign] : {std::pair{"left", -1}, {"right", 1}}) {
    Scene scene = two_regions();
    scene.model.steps[0].loads = {on_side(region, "0.1")};
    Problem p(scene.mesh, scene.model, world());
    const State s = at_end_of_step(p);
    expect_near(load_only(p, s), {-sign * .1, 0, 0});
  }
}

TEST(Loads, OfTheOtherRegionInALaterStepLeaveTheFirst) {
  Scene scene = two_regions();
  scene.model.steps[0].loads = {on_side("left", "0.1")};
  scene.model.steps[1].loads = {on_side("right", "0.3")};
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s), p.set_progress(1, s), p.end_step(), p.begin_step(1, s);
  p.set_progress(0, s);
  expect_near(load_only(p, s), {.1, 0, 0});
  p.set_progress(1, s);
  expect_near(load_only(p, s), {.1 - .3, 0, 0});
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
  const Vec3<double> expected[4][3] = {{{0, 0, 0}, {0, 0, .5}, {0, 0, 1}},
                                       {{0, 0, 1}, {1, 0, 2}, {2, 0, 3}},
                                       {{2, 0, 3}, {2, 0, 3}, {2, 0, 3}},
                                       {}};
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

// Of one kind or direction into another, as nodal forces do.
TEST(Loads, PressuresGoOverIntoThoseThatReplaceThem) {
  Scene scene = standing_block();
  scene.model.steps = {step("one"), step("two"), step("three")};
  for (const auto& [k, direction] : {std::pair{0, Point{1, 0, 0}}, {1, {0, 1, 0}}}) {
    scene.model.steps[k].loads.push_back(pressure("zmax", k == 0 ? "0.2" : "0.3", true));
    scene.model.steps[k].loads[0].direction = direction;
  }
  scene.model.steps[2].loads.push_back(pressure("zmax", "0.1"));
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  const double A = 2;
  const Vec3<double> expected[3][3] = {{{0, 0, 0}, {.1, 0, 0}, {.2, 0, 0}},
                                       {{.2, 0, 0}, {.1, .15, 0}, {0, .3, 0}},
                                       {{0, .3, 0}, {0, .15, -.05}, {0, 0, -.1}}};
  for (int k = 0; k < 3; ++k) {
    p.begin_step(k, s);
    for (int i : {0, 1, 2}) {
      p.set_progress(.5 * i, s);
      Vec3<double> f = expected[k][i];
      for (double& c : f) c *= -A;
      expect_near(load_only(p, s), f);
    }
    p.end_step();
  }
}

TEST(Loads, LoadsOfBothKindsAdd) {
  Scene scene = standing_block();
  scene.model.steps[0].loads = {pressure("zmax", "0.2", true), force("zmax", {1, 0, 0}),
                                pressure("xmax", "0.1")};
  Problem p(scene.mesh, scene.model, world());
  State s = at_end_of_step(p);
  expect_near(load_only(p, s), {-9 + .1 * 3, 0, .4});
}

}  // namespace
}  // namespace bulbus
