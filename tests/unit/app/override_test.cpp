#include "scenes.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;

Scene with(const std::vector<std::string>& overrides) {
  return parse_scene(full_scene, "scene.yaml", overrides);
}

TEST(Override, EntersMapsByKeyAndListsByIndexOrName) {
  EXPECT_EQ(with({"title=b"}).title, "b");
  EXPECT_EQ(with({"mesh.block.nx=9"}).mesh.block->nx, 9);
  EXPECT_EQ(with({"steps.0.increments=7"}).model.steps[0].increments, 7);
  EXPECT_EQ(with({"steps.indent.increments=7"}).model.steps[1].increments, 7);
  EXPECT_EQ(with({"probes.p.unit=kPa"}).model.probes[0].unit, "kPa");
  const std::string bodies = "mesh: {block: {}}\nregions: {}\nsteps: [{move: [{body: plate}]}]\n";
  EXPECT_EQ(parse_scene(bodies, "scene.yaml", {"steps.0.move.plate.close=2"}).model.steps[0].move[0].close,
            2);
  EXPECT_EQ(*with({"steps.indent.displace.side.radial=1 um"}).model.steps[1].displace[1].radial, "0.001 mm");
}

TEST(Override, AddsKeysAndMapsThatTheSceneDoesNotName) {
  EXPECT_EQ(with({"solver.newton.max_iterations=9"}).solver.newton.max_iterations, 9);
  EXPECT_DOUBLE_EQ(with({"regions.new.c10=2 kPa"}).model.regions.at("new").c10, 2e-3);
}

TEST(Override, TakesYamlUnitsEqualsSignsAndNothing) {
  EXPECT_EQ(with({"symmetry=[x, z]"}).model.symmetry.size(), 2u);
  EXPECT_EQ(with({"title=a=b"}).title, "a=b");
  EXPECT_EQ(with({"solver.linear.dump="}).solver.linear.dump, "");
  EXPECT_EQ(std::stod(with({"steps.0.pressures.inside=20 mmHg"}).model.steps[0].pressures.at("inside")),
            20 * mmHg);
}

TEST(Override, TheLastOneHolds) { EXPECT_EQ(with({"title=b", "title=c"}).title, "c"); }

void expect_assignment_refused(const std::string& assignment, const std::string& start,
                               const std::string& part) {
  expect_error(full_scene, "--set " + assignment + ": " + start, part, {assignment});
}

TEST(OverrideErrors, NameTheAssignment) {
  expect_assignment_refused("title", "not of the form path.to.key=value", "--set steps.0.increments=4");
  expect_assignment_refused("=3", "not of the form", "");
  expect_assignment_refused("solver..gamma=3", "an empty name in the path", "");
  expect_assignment_refused("solver.linaer.gamma=3", "unknown key 'linaer' in solver",
                            "did you mean 'linear'?");
  expect_assignment_refused("title.x=3", "title: a single value is wanted here, not a map", "");
  expect_assignment_refused("steps.7.increments=3", "no entry '7' in a list of 3", "entries count from 0");
  expect_assignment_refused("steps.indnt.increments=3", "no entry 'indnt' in a list of 3",
                            "did you mean 'indent'?");
  expect_assignment_refused("mesh.nx=9", "unknown key 'nx' in mesh", "did you mean 'block.nx'?");
  expect_assignment_refused("steps.0.couple=[inside]", "steps.0.couple: the key has another name now",
                            "write 'enclose'");
  expect_assignment_refused("output.every=0", "output.every: '0' is out of bounds", "between 1");
  expect_assignment_refused("output.every={a", "not valid YAML", "");
}

// Counted from 0 the second entry is '1', and so is the first by its name.
TEST(OverrideErrors, NameWhatMeansTwoEntries) {
  const std::string steps = "mesh: {block: {}}\nregions: {}\nsteps: [{name: 1}, {name: 2}, {name: a}]\n";
  expect_error(steps, "--set steps.1.increments=3: '1' is entry 0 and entry 1 of a list", "another name",
               {"steps.1.increments=3"});
  EXPECT_EQ(parse_scene(steps, "scene.yaml", {"steps.0.increments=3"}).model.steps[0].increments, 3);
  const std::string twice =
      "mesh: {block: {}}\nregions: {}\nsteps: [{displace: [{set: a, x: 1}, {set: a, y: 1}]}]\n";
  expect_error(twice, "--set steps.0.displace.a.x=3: 'a' is entry 0 and entry 1 of a list", "give its number",
               {"steps.0.displace.a.x=3"});
}

}  // namespace
