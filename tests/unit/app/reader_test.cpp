#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "scenes.hpp"
#include "tests/support/refusal.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;

Scene full_input() { return parse_scene(full_scene, "scene.yaml"); }

TEST(Reader, ReadsEveryKindOfValue) {
  const Scene s = full_input();
  EXPECT_EQ(s.title, "a: test");
  ASSERT_TRUE(s.mesh.block);
  EXPECT_EQ(s.mesh.block->nx, 3);
  EXPECT_EQ(s.mesh.block->ny, 1);  // a key that is not given keeps its default
  EXPECT_FALSE(s.mesh.eye);
  EXPECT_TRUE(s.model.regions.at("plate").rigid);
  EXPECT_EQ(s.model.regions.at("block").terms.at(0).r, 2);
  EXPECT_EQ(s.model.symmetry, std::vector<std::string>{"x"});
  EXPECT_EQ(s.model.fix[0].directions.size(), 3u);
  EXPECT_EQ(s.model.fix[1].directions,
            std::vector<std::string>{"y"});  // a given list takes the default's place
  EXPECT_EQ(s.model.steps.size(), 3u);
  EXPECT_EQ(s.model.steps[1].displace[1].affine->size(), 9u);
  EXPECT_FALSE(s.model.steps[1].displace[1].rotate);
  EXPECT_TRUE(s.model.steps[1].loads[0].dead);
  EXPECT_EQ(s.solver.linear.op, TangentStorage::assembled);
  EXPECT_EQ(s.solver.newton.max_iterations, 25);
}

TEST(Reader, AugmentsMoreOnRefinedMeshesUnlessTold) {
  const auto gamma = [](const std::vector<std::string>& overrides) {
    return parse_scene(least_scene(""), "scene.yaml", overrides).solver.linear.gamma;
  };
  EXPECT_EQ(gamma({}), LinearSettings().gamma);
  EXPECT_EQ(gamma({"mesh.refine=2"}), 12);
  EXPECT_EQ(gamma({"mesh.refine=2", "solver.accuracy=fast"}), 12);
  EXPECT_EQ(gamma({"mesh.refine=2", "solver.linear.gamma=3"}), 3);
}

TEST(Reader, RefusesNamesThatWouldBreakLinesOfRecords) {
  const std::string scene = least_scene("");
  for (const char* named : {"steps=[{name: \"a\\nb\"}]", "probes=[{name: \"a\\tb\", kind: volume_ratio}]",
                            "liquids={\"a\\rb\": {surface: xmin}}", "mesh.sets={\"a\\u007fb\": X > 0}"})
    expect_refusal([&] { parse_scene(scene, "scene.yaml", {named}); }, {"the name 'a?b' has a line break"});
  EXPECT_EQ(parse_scene(scene, "scene.yaml", {"title=\"a\\nb\""}).title, "a\nb");
}

TEST(Reader, KeepsQuantitiesInTheKeptUnit) {
  const Scene s = full_input();
  EXPECT_DOUBLE_EQ(s.mesh.block->upper[0], 20);
  EXPECT_DOUBLE_EQ(s.model.regions.at("block").c10, 15 * mmHg);
  EXPECT_DOUBLE_EQ(s.model.regions.at("block").terms[0].c, 1e-3);
  EXPECT_DOUBLE_EQ(s.model.steps[1].add.at("inside"), -2);
  EXPECT_DOUBLE_EQ(s.model.steps[1].displace[0].rotate->angle, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ((*s.model.steps[1].displace[0].translate)[2], 5);
  EXPECT_DOUBLE_EQ((*s.model.steps[1].loads[1].force)[2], .1);
}

TEST(Reader, KeepsTheUnitOfAFormulaThatIsANumber) {
  const Scene s = full_input();
  EXPECT_EQ(std::stod(s.model.steps[0].pressures.at("inside")), 15 * mmHg);
  EXPECT_EQ(*s.model.steps[1].displace[0].x, "0.001 mm");
  EXPECT_EQ(*s.model.steps[1].displace[0].y, "0.1*s*(X - 2)");
  EXPECT_EQ(*s.model.steps[1].displace[1].radial, "-0.5");
  EXPECT_EQ(*s.model.steps[1].loads[0].pressure, "t*2e-3");
  EXPECT_FALSE(s.model.steps[1].displace[0].z);
}

TEST(Reader, TakesAnEmptyShapeForItsDefaults) {
  EXPECT_TRUE(parse_scene("mesh:\n  eye:\nregions: {}\nsteps: []\n", "scene.yaml").mesh.eye);
}

TEST(Reader, CountsTheMeshFileFromTheFolderOfTheScene) {
  const std::string text = "mesh: {file: ../m/eye.msh}\nregions: {}\nsteps: []\n";
  EXPECT_EQ(*parse_scene(text, "/data/scenes/a.yaml").mesh.file, "/data/m/eye.msh");
  const auto here = std::filesystem::current_path();
  EXPECT_EQ(*parse_scene(text, "sub/a.yaml").mesh.file, (here / "m/eye.msh").string());
  EXPECT_EQ(*parse_scene("mesh: {file: /x/a.msh}\nregions: {}\nsteps: []\n", "sub/a.yaml").mesh.file,
            "/x/a.msh");
}

TEST(ReaderErrors, UnknownKeyWithTheNearest) {
  expect_error(least_scene("solver:\n  linear:\n    gama: 3\n"),
               "scene.yaml:6: unknown key 'gama' in solver.linear", "did you mean 'gamma'?");
  expect_error(least_scene("prbes: []\n"), "scene.yaml:4: unknown key 'prbes'", "did you mean 'probes'?");
  expect_error(least_scene("fix:\n- set: a\n  qqqqqqqqqqqq: 1\n"),
               "scene.yaml:6: unknown key 'qqqqqqqqqqqq' in fix.0", "known here: set or directions");
  // a slip in a needed key is a slip, not a missing key
  expect_error("mesh: {block: {}}\nregion: {}\nsteps: []\n", "scene.yaml:2: unknown key 'region'",
               "'regions'");
}

TEST(ReaderErrors, MissingKey) {
  expect_error("mesh: {block: {}}\nregions: {}\n", "scene.yaml:1: the key 'steps' is missing", "the history");
  expect_error(least_scene("liquids:\n  a:\n    K: 2\n"),
               "scene.yaml:6: liquids.a: the key 'surface' is missing", "add 'surface: ...'");
  expect_error(least_scene("liquids:\n  a: {surface: }\n"),
               "scene.yaml:5: liquids.a: the key 'surface' is missing", "");
  expect_error(least_scene("liquids:\n  a: {surface: ''}\n"), "scene.yaml:5: liquids.a.surface: is empty",
               "");
  expect_error("", "scene.yaml: the key 'mesh' is missing", "");
}

TEST(ReaderErrors, WrongKindOfValue) {
  expect_error(least_scene("symmetry: x\n"), "scene.yaml:4: symmetry: a list is wanted here, not 'x'",
               "write [a, b]");
  expect_error(least_scene("solver: [1]\n"), "scene.yaml:4: solver: a map is wanted here, not a list",
               "key: value");
  expect_error(least_scene("title: {a: b}\n"),
               "scene.yaml:4: title: a single value is wanted here, not a map", "");
  expect_error(std::string(500, 'a'), "scene.yaml:1: a map is wanted here, not 'aaa",
               std::string(60, 'a') + "...'");
  expect_error("- a\n", "scene.yaml:1: a map is wanted here, not a list", "");
  expect_error(least_scene("output: {vtk: maybe}\n"),
               "scene.yaml:4: output.vtk: 'maybe' is neither true nor false", "write true or false");
  expect_error(least_scene("output: {every: 2.5}\n"),
               "scene.yaml:4: output.every: '2.5' is not a whole number", "between 1 and 1000000");
  expect_error(least_scene("output: {every: 99999999999}\n"), "scene.yaml:4: output.every: '99999999999'",
               "");
  expect_error(least_scene("output: {every: }\n"), "scene.yaml:4: output.every: a single value is wanted",
               "");
  expect_error("mesh: {block: {upper: [1, 2]}}\n", "scene.yaml:1: mesh.block.upper: 2 numbers",
               "write [x, y, z]");
}

TEST(ReaderErrors, WrongNumberOrUnit) {
  expect_error(least_scene("bars:\n  a: {E: stiff}\n"), "scene.yaml:5: bars.a.E: 'stiff' is not a number",
               "give a number in MPa, or with its unit, above 0");
  expect_error(least_scene("bars:\n  a: {E: 3 mm}\n"), "scene.yaml:5: bars.a.E: 'mm' is not a unit that fits",
               "mmHg");
  expect_error(least_scene("solver: {linear: {gamma: 3 mm}}\n"), "scene.yaml:4: solver.linear.gamma: 'mm'",
               "");
  expect_error(least_scene("bars:\n  a: {E: .nan}\n"), "scene.yaml:5: bars.a.E: '.nan' is not a number", "");
  expect_error(least_scene("bars:\n  a: {E: nan}\n"), "scene.yaml:5: bars.a.E: 'nan' is not a number", "");
  expect_error(least_scene("bars:\n  a: {E: 1e999}\n"), "scene.yaml:5: bars.a.E: '1e999' is not a number",
               "");
}

TEST(ReaderErrors, SlipInTheUnitOfAFormula) {
  const auto step = [](const std::string& p) {
    return "mesh: {block: {}}\nregions: {}\nsteps:\n- pressures: {a: " + p + "}\n";
  };
  expect_error(step("15 mmhg"), "scene.yaml:4: steps.0.pressures.a: 'mmhg' is not a unit that fits here",
               "mmHg");
  expect_error(step("15mm"), "scene.yaml:4: steps.0.pressures.a: 'mm' is not a unit that fits here", "");
  expect_error(step("1e999"), "scene.yaml:4: steps.0.pressures.a: '1e999' is not a number", "");
}

TEST(ReaderErrors, OutOfBounds) {
  expect_error(least_scene("solver: {linear: {gamma: -1}}\n"),
               "scene.yaml:4: solver.linear.gamma: '-1' is out of bounds",
               "give a number, between 0 and 10000");
  expect_error(least_scene("bars:\n  a: {E: 0}\n"), "scene.yaml:5: bars.a.E: '0' is out of bounds",
               "above 0");
  expect_error(least_scene("output: {every: 0}\n"), "scene.yaml:4: output.every: '0' is out of bounds",
               "between 1 and");
}

TEST(ReaderErrors, WordNotAmongTheChoices) {
  expect_error(least_scene("solver: {linear: {method: itertive}}\n"),
               "scene.yaml:4: solver.linear.method: 'itertive' is not among the choices",
               "did you mean 'iterative'? choose iterative or direct");
  expect_error(least_scene("symmetry: [x, foo]\n"), "scene.yaml:4: symmetry.1: 'foo' is not among",
               "x, y or z");
}

TEST(ReaderErrors, KeyGivenTwice) {
  expect_error(least_scene("title: a\ntitle: b\n"), "scene.yaml:5: the key 'title' is given twice",
               "line 4 already");
  expect_error(least_scene("bars:\n  a: {}\n  b: {}\n  a: {}\n"), "scene.yaml:7: the key 'a' is given twice",
               "line 5");
}

TEST(ReaderErrors, Syntax) {
  expect_error("title: a\nmesh: {block: {}\nregions: {}\n", "scene.yaml:", "not valid YAML");
  expect_error("title: a\n  mesh: b\n", "scene.yaml:2: not valid YAML", "indentation");
  expect_error("title: a\n---\ntitle: b\n", "scene.yaml:3: a second YAML document begins here", "---");
  expect_error("title: &a [*a]\n", "scene.yaml:1: nested too deeply", "alias");
  expect_error("[a, b]: c\n", "scene.yaml:1: a key must be a word", "");
}

TEST(ReaderErrors, MeshSources) {
  expect_error("mesh: {}\nregions: {}\nsteps: []\n", "scene.yaml:1: mesh: the mesh has no source",
               "give one of file, eye, block, shell, ball or cylinder");
  expect_error("title: t\nmesh:\n  eye:\n  file: a.msh\n",
               "scene.yaml:3: mesh: the mesh has 2 sources: file and eye", "keep exactly one");
}

TEST(ReaderErrors, TwoOfOneName) {
  expect_error(least_scene("probes:\n- {name: a, kind: volume}\n- {name: a, kind: mises}\n"),
               "scene.yaml:", ": probes.1.name: two probes are named 'a'\n  give each its own name");
}

TEST(ReaderErrors, FileThatIsNotThere) {
  try {
    read_scene("/no/such/scene.yaml");
    FAIL();
  } catch (const InputError& fault) {
    EXPECT_EQ(std::string(fault.what()).substr(0, 34), "/no/such/scene.yaml: cannot be rea");
  }
  EXPECT_THROW(read_scene("/tmp"), InputError);
}

TEST(Located, FindsTheLineOfAKeyOrOfWhatIsAroundIt) {
  const auto file = std::filesystem::temp_directory_path() / "bulbus_located.yaml";
  std::ofstream(file) << full_scene;
  const auto says = [&](const std::string& key, const std::vector<std::string>& overrides = {}) {
    return std::string(located(InputError("no such set", key), file, overrides).what());
  };
  EXPECT_EQ(says("steps.1.enclose"), file.string() + ":19: steps.1.enclose: no such set");
  EXPECT_EQ(says("steps.1.displace.1.set"), file.string() + ":23: steps.1.displace.1.set: no such set");
  EXPECT_EQ(says("steps.0.enclose"),
            file.string() + ":15: steps.0.enclose: no such set");  // not written: the step
  EXPECT_EQ(says("fix.0.set", {"fix.0.set=a"}), "--set fix.0.set=a: fix.0.set: no such set");
  EXPECT_EQ(says(""), "no such set");
}

}  // namespace
