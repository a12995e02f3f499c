#include "core/solve/small_change.hpp"

#include "tests/support/two_regions.hpp"
#include "tests/unit/solve/trial.hpp"

namespace bulbus {
namespace {

using namespace test;

TEST(SmallChange, HasToFallToAPartOfTheMostThatWasMissing) {
  SmallChange change(true);
  change.add({1e5, .5}, .9);
  EXPECT_FALSE(change.followed());
  change.add({1e3, 2e4}, .9);
  EXPECT_FALSE(change.followed());
  change.add({99, 19}, .9);
  EXPECT_TRUE(change.followed());
  EXPECT_TRUE(change.small());
}

TEST(SmallChange, IsNoneWhereNothingButRoundingIsMissing) {
  SmallChange change(true);
  change.add({.9, 0}, .9);
  EXPECT_TRUE(change.followed());
}

TEST(SmallChange, EndsWhereItFallsNoMore) {
  SmallChange change(true);
  for (int i = 0; i < 4; ++i) {
    change.add({1e3}, .9);
    EXPECT_FALSE(change.followed()) << i;
  }
  change.add({1e3}, .9);
  EXPECT_TRUE(change.followed());
}

TEST(SmallChange, IsLeftToTheCriteriaWhereTheySeeIt) {
  SmallChange seen(true), before_the_end(false);
  seen.add({1e9}, 2e3), before_the_end.add({1e9}, .9);
  EXPECT_TRUE(seen.followed());
  EXPECT_TRUE(before_the_end.followed());
  EXPECT_FALSE(seen.small());
  EXPECT_FALSE(before_the_end.small());
}

LoadSpec pressure_on(const std::string& surface, double pressure) {
  LoadSpec load;
  load.surface = surface, load.pressure = fmt::format("{:.17g} MPa", pressure);
  return load;
}

LoadSpec shear_on(const std::string& surface, double pressure) {
  LoadSpec load = pressure_on(surface, pressure);
  load.dead = true, load.direction = {1, 0, 0};
  return load;
}

// Mean displacement of the upper end along x in the last step.
double shift_of_end(const Scene& scene, double criterion) {
  Trial run(scene);
  run.settings.newton.force = run.settings.newton.volume = criterion;
  run.go();
  EXPECT_TRUE(run.report.converged) << run.report.reason;
  double sum = 0;
  const auto nodes = run.nodes("zmax");
  for (int n : nodes) sum += run.state.x[3 * n] - run.problem.mesh().X[3 * n];
  return sum / static_cast<double>(nodes.size());
}

// A column, soft above 1 mm, fixed below: pressed in its first step, its upper end sheared in the second one.
Scene column(double lower_c10) {
  Scene s{generate(BlockShape{.upper = {1, 1, 2}, .nx = 2, .ny = 2, .nz = 4, .region = "lower"}), {}};
  split_region(s.mesh, "upper", [](const Point& p) { return p[2] > 1; });
  s.model.regions = {{"lower", neo_hooke(lower_c10)}, {"upper", neo_hooke(8e-4)}};
  s.model.fix.push_back({"zmin", {"x", "y", "z"}});
  s.model.steps = {step("press"), step("shear")};
  s.model.steps[1].loads = {shear_on("zmax", 2e-5)};
  return s;
}

TEST(SmallChange, OfASoftRegionIsFollowedBesideALoadedStiffOne) {
  const double alone = shift_of_end(column(500), 1e-6);
  Scene s = column(500);
  for (const Quad& q : s.mesh.surfaces.at("xmax"))
    if (std::ranges::all_of(q, [&](int n) { return s.mesh.points[n][2] <= 1; }))
      s.mesh.surfaces["side"].push_back(q);
  s.model.steps[0].loads = {pressure_on("side", 5)};
  const double before = [&] {
    Scene pressed = s;
    pressed.model.steps.pop_back();
    return shift_of_end(pressed, 1e-9);
  }();
  EXPECT_GT(alone, .01);
  for (double criterion : {1e-6, 1e-5})  // of tight, of balanced
    EXPECT_NEAR(shift_of_end(s, criterion) - before, alone, .02 * alone) << criterion;
}

TEST(SmallChange, UnderAPressureInBalanceWithItselfIsFollowed) {
  Scene s = column(8e-4);
  const double without = shift_of_end(s, 1e-6);
  for (const char* side : {"xmin", "xmax", "ymin", "ymax", "zmax"})
    for (const Quad& q : s.mesh.surfaces.at(side)) s.mesh.surfaces["all"].push_back(q);
  EXPECT_GT(without, .01);
  for (double pressure : {1., 50.}) {
    s.model.steps[0].loads = {pressure_on("all", pressure)};
    EXPECT_NEAR(shift_of_end(s, 1e-6), without, 1e-3 * without) << pressure;
  }
}

}  // namespace
}  // namespace bulbus
