#include <gtest/gtest.h>

#include "app/records/problem_mark.hpp"
#include "core/io/hdf5_read.hpp"
#include "core/mesh/generate/embed.hpp"
#include "tests/support/left.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"
#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;
namespace fs = std::filesystem;

Comm alone() { return Comm(MPI_COMM_SELF); }

/// What the run leaves behind that nothing interrupts.
const Ran& whole_run() {
  static const Ran ran = [] {
    const Ran r = call("run", fresh_folder("bulbus_whole"), "scene.yaml", full_of_memory, {});
    EXPECT_EQ(r.status, 0) << r.err;
    return r;
  }();
  return ran;
}

void write_scene(const fs::path& folder, const std::string& yaml) {
  std::ofstream(folder / "scene.yaml") << yaml;
}

/// Folders 1, 2, ... as a run leaves them that is killed after that increment.
fs::path left_folders(const std::string& name, const std::string& yaml) {
  const auto folder = fresh_folder(name);
  fs::create_directories(folder / "out");
  write_scene(folder, yaml);
  run_and_leave(read_scene(folder / "scene.yaml"), folder / "out", alone(),
                [&](int number) { fs::copy(folder / "out", folder / std::to_string(number)); });
  return folder;
}

/// A folder with the scene and, in `out`, what is left of its run.
fs::path left_after(int last) {
  static const fs::path folders = left_folders("bulbus_left_folders", full_of_memory);
  const auto folder = fresh_folder("bulbus_left");
  write_scene(folder, full_of_memory);
  fs::copy(folders / std::to_string(last), folder / "out");
  return folder;
}

/// `bulbus run --restart ...` with the scene of the folder.
Ran go_on(const fs::path& folder, const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"run", folder / "scene.yaml"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  std::ostringstream out, err;
  testing::internal::CaptureStdout();
  const int status = command_line(arguments, alone(), out, err);
  testing::internal::GetCapturedStdout();
  return {folder, status, err.str()};
}
Ran go_on(const fs::path& folder) { return go_on(folder, {"-o", folder / "out", "--restart"}); }

void expect_same_end(const Ran& r, double tolerance) {
  const auto found = r.summary(), wanted = whole_run().summary();
  EXPECT_EQ(found["totals"], wanted["totals"]);
  EXPECT_EQ(found["converged"], true);
  for (const auto& [name, value] : not_empty(wanted["probes"]).items())
    EXPECT_LE(std::abs(found["probes"][name].get<double>() - value.get<double>()),
              tolerance * size_of(name, value))
        << name;
  for (const char* name : {"now/x", "now/lambda", "now/P", "start/x", "rigid body tire/now"}) {
    const auto a = read_dataset(r.folder / "out/checkpoint.h5", name),
               b = read_dataset(whole_run().folder / "out/checkpoint.h5", name);
    EXPECT_LE(relative_difference(a, b), tolerance) << name;
  }
}

// The cells of a line but the last, the seconds.
std::vector<std::string> cells(const std::string& line) {
  std::istringstream in(line.substr(0, line.rfind(',')));
  std::vector<std::string> all;
  for (std::string cell; std::getline(in, cell, ',');) all.push_back(cell);
  return all;
}

void expect_same_history(const Ran& r) {
  const auto found = r.lines("history.csv"), wanted = whole_run().lines("history.csv");
  ASSERT_EQ(found.size(), wanted.size());
  EXPECT_EQ(found[0], wanted[0]);
  for (std::size_t i = 1; i < wanted.size(); ++i) {
    const auto a = cells(found[i]), b = cells(wanted[i]);
    ASSERT_EQ(a.size(), b.size()) << found[i];
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (k == 1 || b[k].empty())
        EXPECT_EQ(a[k], b[k]) << found[i];
      else
        EXPECT_NEAR(std::stod(a[k]), std::stod(b[k]), 1e-11 * std::max(std::abs(std::stod(b[k])), .01))
            << found[i];
    }
  }
}

std::vector<std::string> results_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::ranges::sort(names);
  return names;
}

TEST(Restart, EndsWhereAnUninterruptedRunEndsFromEveryIncrement) {
  for (int last = 1; last < increments_of_memory; ++last) {
    const Ran r = go_on(left_after(last));
    ASSERT_EQ(r.status, 0) << r.err;
    expect_same_end(r, 1e-12);
    expect_same_history(r);
    EXPECT_EQ(r.text("result.hdf.series"), whole_run().text("result.hdf.series")) << last;
    EXPECT_EQ(r.text("bodies.pvd"), whole_run().text("bodies.pvd")) << last;
    EXPECT_EQ(results_in(r.folder / "out"), results_in(whole_run().folder / "out")) << last;
    EXPECT_NE(r.text("run.log").find("goes on after increment " + std::to_string(last)), std::string::npos);
    EXPECT_NE(r.text("run.log").find("increment 10 converged"), std::string::npos);
  }
}

TEST(Restart, TakesAwayWhatCameAfterTheCheckpoint) {
  const auto folder = left_after(4);
  fs::copy_file(folder / "out/checkpoint.h5", folder / "fourth.h5");
  ASSERT_EQ(go_on(folder).status, 0);
  std::ofstream(folder / "out/history.csv", std::ios::app) << "10,cut sho";
  std::ofstream(folder / "out/result_0017.hdf") << "late";
  std::ofstream(folder / "out/manifest.txt", std::ios::app) << "result_0017.hdf\n";
  std::ofstream(folder / "out/result_final.hdf") << "mine";
  fs::rename(folder / "fourth.h5", folder / "out/checkpoint.h5");
  const Ran r = go_on(folder);
  ASSERT_EQ(r.status, 0) << r.err;
  expect_same_history(r);
  EXPECT_TRUE(fs::remove(folder / "out/result_final.hdf"));
  EXPECT_EQ(results_in(r.folder / "out"), results_in(whole_run().folder / "out"));
}

TEST(Restart, OfAFinishedRunChangesNothing) {
  const Ran r = go_on(left_after(increments_of_memory));
  ASSERT_EQ(r.status, 0) << r.err;
  expect_same_end(r, 1e-12);
  expect_same_history(r);
}

TEST(Restart, GoesOnElsewhereAndLeavesTheOldFolderAlone) {
  const auto folder = left_after(3);
  const auto before = results_in(folder / "out");
  fs::rename(folder / "out", folder / "old");
  const Ran r = go_on(folder, {"--restart", folder / "old", "-o", folder / "out"});
  ASSERT_EQ(r.status, 0) << r.err;
  expect_same_end(r, 1e-12);
  expect_same_history(r);
  EXPECT_EQ(results_in(folder / "old"), before);
}

TEST(Restart, FindsTheFolderOfItsFile) {
  const auto folder = left_after(7);
  const Ran r = go_on(folder, {"--restart", folder / "out/checkpoint.h5"});
  ASSERT_EQ(r.status, 0) << r.err;
  expect_same_history(r);
}

TEST(Restart, TakesTheSceneBehindIt) {
  const auto folder = left_after(7);
  std::ostringstream out, err;
  EXPECT_EQ(
      command_line({"run", "--restart", folder / "scene.yaml", "-o", folder / "out"}, alone(), out, err), 0)
      << err.str();
}

TEST(Restart, GoesOnThroughAStepThatIsDividedOtherwise) {
  const auto folder = left_after(9);
  const auto drain = full_of_memory.find("  - name: drain");
  write_scene(folder, full_of_memory.substr(0, drain) +
                          replaced(full_of_memory.substr(drain), "increments: 2", "increments: 4"));
  const Ran r = go_on(folder);
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.summary()["totals"]["increments"], increments_of_memory + 1);
}

// What a step does from its beginning must not be judged by what it has done so far.
void expect_same_end(const std::string& name, const std::string& yaml, int increments) {
  const Ran whole = call("run", fresh_folder(name + "_whole"), "scene.yaml", yaml, {});
  ASSERT_EQ(whole.status, 0) << whole.err;
  const auto left = left_folders(name, yaml);
  for (int k = 1; k < increments; ++k) {
    const auto folder = fresh_folder(name + "_left");
    write_scene(folder, yaml);
    fs::copy(left / std::to_string(k), folder / "out");
    const Ran r = go_on(folder);
    ASSERT_EQ(r.status, 0) << k << r.err;
    for (const auto& [probe, value] : whole.summary()["probes"].items())
      EXPECT_NEAR(r.summary()["probes"][probe].get<double>(), value.get<double>(),
                  1e-6 * std::abs(value.get<double>()))
          << probe << k;
  }
}

TEST(Restart, GoesOnWhereMoreThanHalfOfALiquidIsDrained) {
  expect_same_end("bulbus_drained", R"yaml(mesh: {shell: {inner: 2, outer: 4, n: 2, layers: 2, part: octant}}
regions: {shell: {c10: 50 kPa}}
liquids: {inside: {surface: inner}}
symmetry: [x, y, z]
steps:
  - {name: fill, pressures: {inside: 0.1 kPa}}
  - {name: drain, increments: 4, enclose: [inside], add: {inside: -20}}
probes: [{name: V, kind: volume, liquid: inside}]
solver: {linear: {method: direct}}
output: {checkpoint: 1}
)yaml",
                  5);
}

TEST(Restart, GoesOnAmidATurnFromTouch) {
  expect_same_end("bulbus_wiped", R"yaml(mesh: {block: {upper: [4, 4, 1], nx: 8, ny: 8, nz: 2}}
regions: {block: {c10: 50 kPa}}
fix: [{set: zmin, directions: [x, y, z]}]
rigid_bodies: {ball: {sphere: {center: [2, 2, 2], radius: 0.5}}}
contacts: [{name: c, slave: zmax, master: ball}]
steps:
  - name: wipe
    increments: 8
    move: [{body: ball, from: touch, translate: [0, 0, -0.02], rotate: {axis: [0, 0, 1], center: [-8, 2, 0], angle: 60 deg}}]
probes: [{name: u, kind: displacement, set: zmax, statistic: max}]
solver: {linear: {method: direct}}
output: {checkpoint: 1}
)yaml",
                  8);
}

/// Refused with status 2 and a message that begins with the file; the folder stays as it was.
void expect_refused(const fs::path& folder, const std::string& message,
                    const std::vector<std::string>& more = {}) {
  const auto before = results_in(folder / "out");
  std::vector<std::string> arguments{"-o", folder / "out", "--restart"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Ran r = go_on(folder, arguments);
  EXPECT_EQ(r.status, 2);
  EXPECT_EQ(r.err.find((folder / "out/checkpoint.h5").string() + ": " + message), 0u) << r.err;
  EXPECT_NE(r.err.find("run without --restart"), std::string::npos) << r.err;
  EXPECT_EQ(results_in(folder / "out"), before);
}

TEST(Restart, RefusesAnotherProblemAndSaysWhatDiffers) {
  const auto folder = left_after(4);
  for (const auto& [from, to, message] :
       {std::array{"c10: 80 kPa", "c10: 81 kPa",
                   "is of another problem: the scene says something else under 'regions'"},
        std::array{"close: 0.3", "close: 0.4",
                   "is of another problem: the scene says something else under 'steps', no later than"},
        std::array{"tolerance: 0.002", "tolerance: 0.003",
                   "is of another problem: the scene says something else under 'contacts'"},
        std::array{"n: 4, layers: 2, part: octant}", "n: 4, layers: 2, part: octant}, sets: {a: \"X < 1\"}",
                   "is of another problem: the scene says something else under 'mesh'"},
        std::array{"outer: 12,", "outer: 12.01,", "is of another mesh of the same size"},
        std::array{"n: 4, layers: 2", "n: 4, layers: 3", "is of another mesh: 96 hexahedra"}}) {
    write_scene(folder, replaced(full_of_memory, from, to));
    expect_refused(folder, message);
  }
  write_scene(folder, full_of_memory);
  expect_refused(folder, "is of another problem", {"--set", "liquids.inside.K=2000"});
  write_scene(folder, replaced(replaced(full_of_memory, "title: everything", "title: all"), "angle: 2 deg",
                               "angle: 3 deg"));
  EXPECT_EQ(go_on(folder).status, 0);  // what came later may change
}

/// Nodes and hexahedra are the same.
TEST(Restart, RefusesOtherBarsOfTheEye) {
  const auto folder = fresh_folder("bulbus_bars");
  const std::string eye = R"yaml(mesh: {eye: {n: 4}}
materials: paper
bars: {zonules: {E: 100, area: 1e-3}}
symmetry: [x]
fix: [{set: nerve_end}]
steps: [{name: pull, displace: [{set: apex, z: 0.01}]}]
output: {checkpoint: 1, vtk: false}
)yaml";
  ASSERT_EQ(call("run", folder, "scene.yaml", eye, {}).status, 0);
  EXPECT_EQ(go_on(folder).status, 0);
  for (const char* set : {"mesh.eye.zonules.equatorial=10", "mesh.eye.zonules.posterior_from=138"})
    expect_refused(folder, "is of another mesh with the same nodes: its bars differ", {"--set", set});
}

TEST(Restart, RefusesOtherNamesInTheSameMesh) {
  const auto scene = parse_scene(R"yaml(mesh: {block: {nx: 2}}
regions: {block: {c10: 1}, soft: {c10: 1}}
bars: {b: {E: 1, area: 1}}
fix: [{set: xmin}]
steps: [{displace: [{set: xmax, z: 0.1}]}]
)yaml",
                                 "scene.yaml");
  Mesh mesh = generate(*scene.mesh.block);
  mesh.region_names = {"block", "soft"}, mesh.region = {0, 1};
  mesh.bars["b"] = {{at_node(0), at_node(4)}, {at_node(1), at_node(5), .5}};
  mesh.node_sets["s"] = {0, 1};
  const auto mark = [&](const Mesh& of) { return mark_of(scene, {}, Problem(of, scene.model, alone()), 0); };
  ProblemMark kept = mark(mesh);
  EXPECT_NO_THROW(refuse_another(kept, mark(mesh), {}, "checkpoint.h5"));
  using Change = std::function<void(Mesh&)>;
  const std::vector<std::pair<std::string, Change>> changes{
      {"regions",
       [](Mesh& m) {
         m.region = {1, 0};
       }},
      {"bars", [](Mesh& m) { m.bars["b"].pop_back(); }},
      {"bars", [](Mesh& m) { m.bars["b"][1].share = 1; }},
      {"bars", [](Mesh& m) { m.bars["b"][1].b = at_node(6); }},
      {"surfaces", [](Mesh& m) { m.surfaces["xmin"] = m.surfaces["ymin"]; }},
      {"node sets",
       [](Mesh& m) {
         m.node_sets["s"] = {0, 2};
       }},
      {"node sets", [](Mesh& m) { m.node_sets["t"] = {0}; }}};
  for (const auto& [kind, change] : changes) {
    Mesh other = mesh;
    change(other);
    const ProblemMark here = mark(other);
    expect_refusal([&] { refuse_another(kept, here, {}, "checkpoint.h5"); }, {"its " + kind + " differ"});
  }
  kept.named.clear();  // as versions before wrote it
  EXPECT_NO_THROW(refuse_another(kept, mark(mesh), {}, "checkpoint.h5"));
}

TEST(Restart, RefusesWhatIsNoCheckpoint) {
  const auto folder = left_after(3);
  const fs::path file = folder / "out/checkpoint.h5";
  fs::resize_file(file, fs::file_size(file) / 2);
  expect_refused(folder, "no whole checkpoint");
  fs::remove(file);
  fs::copy_file(folder / "out/result_0002.hdf", file);
  expect_refused(folder, "no whole checkpoint");
  fs::remove(file);
  expect_refused(folder, "there is no such checkpoint");
}

TEST(Restart, NeedsNoCheckpointsToBeWrittenByDefault) {
  const Ran r = run_scene(
      "mesh: {block: {}}\nregions: {block: {c10: 1}}\nfix: [{set: zmin}]\nsteps: [{displace: [{set: zmax, z: "
      ".1}]}]\n");
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_FALSE(r.wrote("checkpoint.h5"));
}

/// The increment that fails, the first of a step, is tried again with what the scene says now of the solver.
TEST(Restart, GoesOnWhereARunDidNotConverge) {
  const auto folder = left_after(3);
  fs::rename(folder / "out", folder / "left");
  const Ran failed = go_on(folder, {"-o", folder / "out", "--restart", folder / "left", "--set",
                                    "solver.newton.max_iterations=1", "output.checkpoint=100"});
  ASSERT_EQ(failed.status, 1) << failed.err;
  ASSERT_EQ(failed.summary()["totals"]["increments"], 3);
  const Ran r = go_on(folder);
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NE(r.text("run.log").find("0 of step 2 of 4 is done"), std::string::npos);
  const auto wanted = whole_run().summary()["probes"], found = r.summary()["probes"];
  for (const auto& [name, value] : not_empty(wanted).items())
    EXPECT_LE(std::abs(found[name].get<double>() - value.get<double>()), 1e-12 * size_of(name, value))
        << name;
}

/// The last increment has its checkpoint whatever the interval, before its step is closed.
TEST(Restart, TakesMoreStepsBehindAFinishedRun) {
  const auto drain = full_of_memory.find("  - name: drain"), probes = full_of_memory.find("probes:");
  const std::string shorter =
      replaced(std::string(full_of_memory).erase(drain, probes - drain), "checkpoint: 1", "checkpoint: 100");
  const Ran first = call("run", fresh_folder("bulbus_longer"), "scene.yaml", shorter, {});
  ASSERT_EQ(first.status, 0) << first.err;
  write_scene(first.folder, full_of_memory);
  const Ran r = go_on(first.folder);
  ASSERT_EQ(r.status, 0) << r.err;
  expect_same_end(r, 1e-12);
}

TEST(Forecast, CountsIncrementsAtThePriceOfTheLast) {
  const std::vector<StepSpec> steps{{.increments = 4}, {.increments = 10}};
  Forecast forecast;
  EXPECT_NEAR(forecast.after({.step = 0, .progress = .25, .next = .25}, steps, 2), 13 * 2, 1e-12);
  EXPECT_NEAR(forecast.after({.step = 0, .progress = .5, .next = .125}, steps, 2), 14 * 2,
              1e-12);  // cut: twice as many
  const double dearer = forecast.after({.step = 1, .progress = .5, .next = .1}, steps, 4);
  EXPECT_GT(dearer, 5 * 2);
  EXPECT_LT(dearer, 5 * 4);
  EXPECT_EQ(forecast.after({.step = 1, .progress = 1, .next = .1}, steps, 4), 0);
}

}  // namespace
