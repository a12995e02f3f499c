#include <gtest/gtest.h>

#include "app/records/diagnosis.hpp"
#include "core/io/hdf5_read.hpp"
#include "core/solve/dump.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;
namespace fs = std::filesystem;

// Line 11 is the first probe.
const std::string scene = R"yaml(title: stretch
mesh: {block: {upper: [2, 1, 1], nx: 2, ny: 2, nz: 2}}
regions:
  block: {c10: 0.5}
symmetry: [x, y, z]
steps:
  - name: stretch
    increments: 2
    displace: [{set: xmax, x: 0.8}]
probes:
  - {name: pull, kind: reaction, set: xmax, component: x, unit: mN}
  - {name: stress, kind: mises}
solver:
  linear: {method: direct}
  newton: {force: 1e-11, volume: 1e-11}
)yaml";

/// c10 = 1/2, stretch 1.4, a quarter of the section 1 × 1 in the model.
TEST(Run, WritesTheAnswerAndHowItWasFound) {
  const Ran r = run_scene(scene);
  ASSERT_EQ(r.status, 0) << r.err;
  const auto s = r.summary();
  EXPECT_EQ(s["converged"], true);
  EXPECT_EQ(s["title"], "stretch");
  EXPECT_EQ(s["unknowns"]["element_pressure"], 8);
  EXPECT_EQ(s["unknowns"]["total"], s["unknowns"]["displacement"].get<int>() + 8);
  EXPECT_EQ(s["unknowns"]["displacement"],
            9 + 18 + 18);  // 27 nodes; x is held on both ends, y and z on one side
  EXPECT_EQ(s["units"]["pull"], "mN");
  EXPECT_EQ(s["units"]["stress"], "MPa");
  const double l = 1.4, P = l - 1 / (l * l);
  EXPECT_NEAR(s["probes"]["stress"], l * P, 1e-9);
  EXPECT_NEAR(s["probes"]["pull"], 0, 1e-9);  // the image in x = 0 pulls the other way
  ASSERT_EQ(s["steps"].size(), 1u);
  EXPECT_EQ(s["steps"][0]["increments"], 2);
  EXPECT_EQ(s["totals"]["newton_iterations"], s["steps"][0]["newton_iterations"]);
  EXPECT_EQ(s["negative_pivots"], 8);
  EXPECT_EQ(s["negative_pivots_if_stable"], 8);
  EXPECT_GE(s["factor"]["factor_entries"], s["factor"]["matrix_entries"]);
  EXPECT_EQ(s["factor"]["ordering"], "Scotch");
  EXPECT_GT(s["factor"]["flops"], 0);
  EXPECT_LT(s["factor"]["largest_residual"], 1e-6);  // of late, tiny right-hand sides
  EXPECT_GT(s["memory_mb"]["process_peak"]["largest_rank"], 1);
  EXPECT_EQ(s["ranks"], 1);
  for (const char* file :
       {"resolved.yaml", "run.log", "result.hdf.series", "result_0001.hdf", "result_0002.hdf"})
    EXPECT_TRUE(r.wrote(file)) << file;
}

TEST(Run, KeepsTheHistory) {
  const Ran r = run_scene(
      replaced(scene, "symmetry: [x, y, z]", "symmetry: [y, z]\nfix: [{set: xmin, directions: [x]}]"));
  ASSERT_EQ(r.status, 0) << r.err;
  const auto lines = r.lines("history.csv");
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "increment,step,time,pull,stress,newton_iterations,krylov_iterations,cuts,seconds");
  EXPECT_EQ(lines[1].substr(0, 14), "1,stretch,0.5,");
  const double P = 1.4 - 1 / (1.4 * 1.4);
  EXPECT_NEAR(r.summary()["probes"]["pull"], 4e3 * P, 1e-5);  // the whole section is 2 × 2
  EXPECT_EQ(lines[2].substr(0, 12), "2,stretch,1,");
  EXPECT_NEAR(std::stod(lines[2].substr(12)), 4e3 * P, 1e-5);
}

TEST(Run, SavesFieldsThatAgreeWithEachOther) {
  const Ran r = run_scene(scene, {"output.every=2"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_FALSE(r.wrote("result_0001.hdf"));
  const std::string file = r.folder / "out" / "result_0002.hdf";
  const double l = 1.4, stress = l * l - 1 / l;
  const auto field = [&](const std::string& name) { return read_dataset(file, "VTKHDF/" + name); };
  for (const char* place : {"PointData/stress", "CellData/stress"}) {
    const auto s = field(place);
    ASSERT_FALSE(s.empty()) << place;
    for (std::size_t i = 0; i < s.size(); ++i)
      EXPECT_NEAR(s[i], i % 6 == 0 ? stress : 0, 1e-6) << place << ' ' << i;
  }
  for (double v : not_empty(field("PointData/mises"))) EXPECT_NEAR(v, stress, 1e-6);
  for (double v : not_empty(field("CellData/pressure"))) EXPECT_NEAR(v, -stress / 3, 1e-6);
  for (double v : not_empty(field("CellData/J"))) EXPECT_NEAR(v, 1, 1e-6);
  for (double v : not_empty(field("CellData/region"))) EXPECT_EQ(v, 0);
  const auto X = field("Points"), u = field("PointData/displacement");
  ASSERT_EQ(X.size(), u.size());
  ASSERT_FALSE(X.empty());
  for (std::size_t i = 0; i < X.size(); i += 3) EXPECT_NEAR(u[i], (l - 1) * X[i], 1e-6);
}

TEST(Run, SavesTheLastStateWhateverTheInterval) {
  const Ran r = run_scene(scene, {"output.every=5", "output.fields=[displacement]"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_TRUE(r.wrote("result_0002.hdf"));
  EXPECT_FALSE(run_scene(scene, {"output.vtk=false"}).wrote("result_0002.hdf"));
}

/// The block may shrink to a tenth of its length, not to nothing: the last good state stays on the disk.
TEST(Run, TellsWhyItDidNotConverge) {
  const Ran r = run_scene(replaced(scene, "x: 0.8", "x: \"-2.2*s\""),
                          {"solver.stepping.minimum=0.1", "solver.newton.max_iterations=6"});
  EXPECT_EQ(r.status, 1);
  const auto s = r.summary();
  EXPECT_EQ(s["converged"], false);
  EXPECT_NE(s["reason"].get<std::string>().find("stretch"), std::string::npos);
  EXPECT_GT(s["totals"]["cuts"], 0);
  EXPECT_EQ(r.lines("history.csv").size(), 1 + s["totals"]["increments"].get<std::size_t>());
  EXPECT_NE(r.text("run.log").find("cut:"), std::string::npos);
  EXPECT_NE(r.text("run.log").find("error: not converged"), std::string::npos);
}

TEST(Run, TakesAwayTheRecordsOfAnEarlierRun) {
  Ran r = run_scene(scene);
  for (const char* mine :
       {"result_final.hdf", "bodies_paper.vtp", "result_9.hdf", "result_0009.hdf", "notes.txt"})
    std::ofstream(r.folder / "out" / mine) << "mine";
  std::ostringstream out, err;
  EXPECT_EQ(
      command_line({"run", r.folder / "scene.yaml", "-o", r.folder / "out", "--set", "steps.0.increments=1"},
                   Comm(MPI_COMM_SELF), out, err),
      0);
  EXPECT_FALSE(r.wrote("result_0002.hdf"));
  for (const char* mine :
       {"result_final.hdf", "bodies_paper.vtp", "result_9.hdf", "result_0009.hdf", "notes.txt"})
    EXPECT_EQ(r.text(mine), "mine") << mine;
}

struct Fault {
  std::string from, to, message;
};

TEST(Run, WrongInputIsFoundBeforeAnythingIsWritten) {
  for (const Fault& f : std::vector<Fault>{
           {"  block: {c10: 0.5}", "  lens: {c10: 0.5}", "scene.yaml:4: regions.lens: "},
           {"regions:\n  block: {c10: 0.5}", "regions: {}", "scene.yaml:3: regions: "},
           {"unit: mN", "unit: mmHg", "scene.yaml:11: probes.0.unit: "},
           {"x: 0.8", "x: 0.8*q", "scene.yaml:9: steps.0.displace.0.x: "},
           {"set: xmax, x: 0.8", "set: xmx, x: 0.8", "scene.yaml:9: steps.0.displace.0.set: "}}) {
    for (const char* command : {"run", "check"}) {
      const Ran r = run_scene(replaced(scene, f.from, f.to), {}, command);
      EXPECT_EQ(r.status, 2) << f.to;
      EXPECT_NE(r.err.find(f.message), std::string::npos) << r.err;
      EXPECT_FALSE(fs::exists(r.folder / "out"));
    }
  }
}

/// A slip in the second step is found before the first is solved.
TEST(Run, RehearsesEveryStep) {
  const Ran r = run_scene(replaced(scene, "probes:", "  - displace: [{set: xmax, x: 0.8*q}]\nprobes:"));
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("scene.yaml:10: steps.1.displace.0.x: "), std::string::npos) << r.err;
  EXPECT_FALSE(fs::exists(r.folder / "out"));
}

TEST(Run, RefusesAFolderThatCannotBe) {
  const Ran r = run_scene(scene);
  std::ostringstream out, err;
  const std::string file = r.folder / "scene.yaml";
  EXPECT_EQ(command_line({"run", file, "-o", file}, Comm(MPI_COMM_SELF), out, err), 2);
}

/// The dumped system is the one that is solved.
TEST(Run, DumpsEverySystem) {
  const Ran r = run_scene(scene, {"solver.linear.dump=systems"});
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string folder = r.folder / "out/systems";
  const int solves = r.summary()["totals"]["newton_iterations"];
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), solves);
  const SystemDump d = read_system(folder + "/system_0001.h5");
  EXPECT_EQ(d.rhs.size(), d.kind.size());
  EXPECT_EQ(d.rhs.size(), d.scaling.size());
  EXPECT_EQ(d.attributes.at("increment"), 1);
  EXPECT_EQ(d.attributes.at("gamma"), 0);
  EXPECT_EQ(d.attributes.at("converged"), 1);
  EXPECT_EQ(d.attributes.at("negative_pivots"), 8);  // one per hexahedron
}

/// With its solution, and with rigid motions that nothing resists in a body free of stress.
TEST(Run, DumpsSolutionAndNearNullSpace) {
  const Ran r = run_scene(scene, {"solver.linear.dump=systems", "mesh.block.nx=5", "mesh.block.ny=3",
                                  "mesh.block.nz=3", "steps.0.increments=1"});
  ASSERT_EQ(r.status, 0) << r.err;
  const SystemDump d = read_system(r.folder / "out/systems/system_0001.h5");
  const std::size_t n = d.rhs.size();
  ASSERT_EQ(d.coordinates.size(), 3 * n);
  ASSERT_EQ(d.near_null_space.size(), 6 * n);
  std::vector<double> missing = d.rhs, size(n), action(6 * n), magnitude(6 * n);
  for (std::size_t i = 0; i < n; ++i) size[i] = std::abs(d.rhs[i]);
  for (std::size_t k = 0; k < d.matrix.row.size(); ++k) {
    const int row = d.matrix.row[k], col = d.matrix.col[k];
    const double a = d.matrix.value[k];
    missing[row] -= a * d.solution[col];
    size[row] += std::abs(a * d.solution[col]);
    if (d.kind[col] != UnknownKind::displacement) continue;
    for (int m = 0; m < 6; ++m) {
      action[6 * row + m] += a * d.near_null_space[6 * col + m];
      magnitude[6 * row + m] += std::abs(a * d.near_null_space[6 * col + m]);
    }
  }
  for (std::size_t i = 0; i < n; ++i) EXPECT_LE(std::abs(missing[i]), 1e-10 * size[i]) << i;
  // Of a node with free ones alone around it: cells are 0.4 × ⅓ × ⅓, and x = 0, x = 2, y = 0 and z = 0 are
  // held.
  const auto is_interior = [&](std::size_t i) {
    const double* x = &d.coordinates[3 * i];
    return x[0] > 0.7 && x[0] < 1.3 && x[1] > 0.6 && x[2] > 0.6;
  };
  int seen = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (d.kind[i] != UnknownKind::displacement || !is_interior(i)) continue;
    ++seen;
    for (int m = 0; m < 6; ++m)
      EXPECT_LE(std::abs(action[6 * i + m]), 1e-12 * magnitude[6 * i + m]) << i << " " << m;
  }
  EXPECT_GT(seen, 10);
}

TEST(Run, WritesADumpAsMatrixMarket) {
  const Ran r = run_scene(scene, {"solver.linear.dump=systems"});
  const std::string dump = r.folder / "out/systems/system_0002.h5";
  std::ostringstream out, err;
  EXPECT_EQ(command_line({"matrix-market", dump}, Comm(MPI_COMM_SELF), out, err), 0) << err.str();
  const std::size_t n = read_system(dump).rhs.size();
  for (const auto& [part, size] : {std::pair{"_near_null_space", fmt::format("{} 6", n)},
                                   {"_coordinates", fmt::format("{} 3", n)},
                                   {"_solution", fmt::format("{} 1", n)}}) {
    std::ifstream in(dump.substr(0, dump.size() - 3) + part + ".mtx");
    std::string first, second;
    std::getline(in, first), std::getline(in, second);
    EXPECT_EQ(second, size) << part;
  }
  EXPECT_EQ(command_line({"matrix-market", dump, "-o", "a.txt"}, Comm(MPI_COMM_SELF), out, err), 2);
  EXPECT_EQ(command_line({"matrix-market", "/no/such.h5"}, Comm(MPI_COMM_SELF), out, err), 2);
}

TEST(Check, AcceptsAScene) {
  const Ran r = run_scene(scene, {}, "check");
  EXPECT_EQ(r.status, 0) << r.err;
}

TEST(Run, IsRefusedBeforeItStartsWhereMemoryDoesNotSuffice) {
  for (const char* command : {"check", "run"}) {
    const Ran r =
        run_scene(scene, {"solver.linear.method=iterative", "solver.linear.memory_limit=1"}, command);
    EXPECT_EQ(r.status, 2) << command;
    EXPECT_NE(r.err.find("more than the 1 MB that solver.linear.memory_limit allows"), std::string::npos)
        << r.err;
    EXPECT_NE(r.err.find("Refine once less"), std::string::npos) << r.err;
    EXPECT_FALSE(r.wrote("summary.json"));
  }
}

// Whoever solves directly is not told to.
TEST(Diagnosis, AdvisesWhatHasNotBeenTried) {
  FailureFacts failed{.outcome = Outcome::linear_solver_failed};
  EXPECT_NE(diagnosis(failed).find("method: direct"), std::string::npos);
  failed.direct = true;
  EXPECT_EQ(diagnosis(failed).find("method: direct"), std::string::npos);
}

}  // namespace
