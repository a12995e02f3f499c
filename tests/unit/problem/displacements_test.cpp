#include "tests/unit/problem/standing_block.hpp"

namespace bulbus {
namespace {

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

/// Where the prescribed increment leads to.
State obeyed(const Problem& p, State s, double progress) {
  std::vector<double> du(s.x.size());
  p.dofs().prescribed_increment(s, progress, du);
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
    EXPECT_GT(world().sum(static_cast<int>(p.nodes_of("zmax").size())), 0);
    for (int n : p.nodes_of("zmax"))
      expect_near(at(end.x, n), place(at(p.mesh().X, n), at(start.x, n)), 1e-13);
  }
};

TEST_F(Displaced, NumbersAreReachedLinearlyFromWhereTheStepStarts) {
  d.z = "0.5";
  expect_places(.25, [](auto X, auto x) {
    return Vec3<double>{x[0], x[1], x[2] + .25 * (X[2] + .5 - x[2])};
  });
}

TEST_F(Displaced, NumbersCountFromTheStartIfAsked) {
  d.z = "0.5", d.from = "start";
  expect_places(.25, [](auto, auto x) { return Vec3<double>{x[0], x[1], x[2] + .125}; });
}

TEST_F(Displaced, FormulasKnowThePlace) {
  d.x = "X*s + t", d.y = "0.1*Z*Y";
  expect_places(.5, [](auto X, auto x) {
    return Vec3<double>{X[0] + X[0] * .5 + .5, X[1] + .3 * X[1], x[2]};
  });
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
  expect_places(
      1,
      [](auto X, auto x) {
        const double r = std::hypot(X[0] + 1, X[1] + 1), k = (r + .5) / r;
        return Vec3<double>{-1 + k * (X[0] + 1), -1 + k * (X[1] + 1), x[2]};
      },
      true);
}

// A set that has turned about the axis is as far from it as before, and does not move.
TEST_F(Displaced, RadiallyFromAnAxisAfterATurn) {
  d.radial = "0", d.center = {-1, -1, 0};
  scene.model.steps[0].displace = {d};
  Problem p(scene.mesh, scene.model, world());
  State start = p.initial_state();
  for (int n = 0; n < p.mesh().nodes(); ++n) {
    const double x = start.x[3 * n] + 1, y = start.x[3 * n + 1] + 1, c = std::cos(.5), s = std::sin(.5);
    start.x[3 * n] = c * x - s * y - 1, start.x[3 * n + 1] = s * x + c * y - 1;
  }
  p.begin_step(0, start);
  p.set_progress(1, start);
  const State end = obeyed(p, start, 1);
  for (int n : p.nodes_of("zmax")) expect_near(at(end.x, n), at(start.x, n), 1e-13);
}

TEST_F(Displaced, AlongALineReplacesWhateverTheVector) {
  scene.model.steps = {step("one"), step("two"), step("three")};
  d.by = "0.1", d.along = {0, 3, 4};
  scene.model.steps[0].displace = {d};
  d.by = "0.2", d.along = {0, .3, .4};
  scene.model.steps[1].displace = {d};
  d.by = "-0.4", d.along = {0, -6, -8};
  scene.model.steps[2].displace = {d};
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  for (double moved : {.1, .2, .4}) {
    p.begin_step(moved == .1 ? 0 : moved == .2 ? 1 : 2, s);
    p.set_progress(1, s);
    s = obeyed(p, s, 1);
    p.end_step();
    for (int n : p.nodes_of("zmax"))
      EXPECT_NEAR(dot({0, .6, .8}, minus(at(s.x, n), at(p.mesh().X, n))), moved, 1e-13);
  }
}

TEST_F(Displaced, AlongTwoDirectionsInTwoStepsKeepsBoth) {
  scene.model.steps = {step("one"), step("two")};
  d.by = "0.1", d.along = {1, 0, 0};
  scene.model.steps[0].displace = {d};
  d.by = "0.2", d.along = {0, 1, 0};
  scene.model.steps[1].displace = {d};
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  for (int k : {0, 1}) {
    p.begin_step(k, s);
    p.set_progress(1, s);
    s = obeyed(p, s, 1);
    p.end_step();
  }
  for (int n : p.nodes_of("zmax"))
    expect_near(minus(at(s.x, n), at(p.mesh().X, n)), {.1, .2, s.x[3 * n + 2] - p.mesh().X[3 * n + 2]},
                1e-13);
  for (int n : p.nodes_of("zmax")) EXPECT_TRUE(p.dofs().constrains(n, {1, 0, 0}));
}

TEST_F(Displaced, NodeOnTheRadialAxisIsRefused) {
  d.radial = "0.5";
  scene.model.steps[0].displace = {d};
  Problem p(scene.mesh, scene.model, Comm(MPI_COMM_SELF));
  EXPECT_THROW(p.begin_step(0, p.initial_state()), InputError);
}

TEST_F(Displaced, AffineFromTheReference) {
  d.affine = std::vector<double>{1.2, .1, 0, 0, .9, 0, .3, 0, 1};
  expect_places(1, [](auto X, auto) {
    return Vec3<double>{1.2 * X[0] + .1 * X[1], .9 * X[1], .3 * X[0] + X[2]};
  });
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
  EXPECT_GT(world().sum(static_cast<int>(p.nodes_of("zmax").size())), 0);
  for (int n : p.nodes_of("zmax")) {
    EXPECT_NEAR(s.x[3 * n] - p.mesh().X[3 * n], .1, 1e-14);
    EXPECT_NEAR(s.x[3 * n + 2] - p.mesh().X[3 * n + 2], .4, 1e-14);
  }
  p.end_step(), p.begin_step(2, s);
  for (int n : p.nodes_of("zmax")) EXPECT_FALSE(p.dofs().constrained(n));
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

}  // namespace
}  // namespace bulbus
