// Runs that cannot finish, as a user runs them: exit status 1, the reason, and the last good state in files
// without a NaN.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/command_line.hpp"
#include "core/io/hdf5_read.hpp"
#include "tests/extremes/run.hpp"

namespace bulbus {
namespace {

namespace fs = std::filesystem;

/// A scene that was run into a folder of its own, which goes with it.
struct Left {
  fs::path folder = fs::temp_directory_path() / ("bulbus_extremes_" + std::to_string(getpid()));
  int status = 0;
  std::string err;
  nlohmann::json summary;

  explicit Left(const std::string& scene) {
    fs::create_directories(folder);
    std::ofstream(folder / "scene.yaml") << scene;
    run({"run", (folder / "scene.yaml").string(), "-o", (folder / "out").string()});
  }
  ~Left() { fs::remove_all(folder); }
  void again() {
    run({"run", (folder / "scene.yaml").string(), "-o", (folder / "out").string(), "--restart"});
  }

  /// Files with a number that is none: as text, or among the displacements of a saved state.
  std::vector<std::string> not_finite() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "out")) {
      const std::string name = entry.path().filename(), type = entry.path().extension();
      const bool bad =
          type == ".hdf"
              ? !std::isfinite(largest(read_dataset(entry.path(), "VTKHDF/PointData/displacement")))
          : type == ".csv" || type == ".json" ? speaks_of_nan(entry.path())
                                              : false;
      if (bad) found.push_back(name);
    }
    return found;
  }
  int states() const {
    int count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "out"))
      count += entry.path().extension() == ".hdf";
    return count;
  }

 private:
  void run(const std::vector<std::string>& arguments) {
    std::ostringstream said, faults;
    status = command_line(arguments, Comm(MPI_COMM_SELF), said, faults);
    err = faults.str();
    std::ifstream file(folder / "out" / "summary.json");
    if (file) summary = nlohmann::json::parse(file);
  }
  static bool speaks_of_nan(const fs::path& path) {
    std::ifstream in(path);
    std::stringstream text;
    text << in.rdbuf();
    for (const char* word : {"nan", "NaN", "inf", ",null", ": null"})
      if (text.str().find(word) != std::string::npos) return true;
    return false;
  }
};

/// The figures of a run that stopped, as its row.
void expect_left(const std::string& extreme, const std::string& value, Left& left, const std::string& probe) {
  EXPECT_EQ(left.status, 1) << left.err;
  ASSERT_FALSE(left.summary.is_null());
  const auto bad = left.not_finite();
  EXPECT_TRUE(bad.empty()) << bad.front();
  EXPECT_GE(left.states(), 2);
  EXPECT_FALSE(left.summary["reason"].get<std::string>().empty());
  const auto totals = left.summary["totals"];
  const double last = left.summary["probes"][probe];
  const int before = left.states();
  left.again();
  EXPECT_EQ(left.status, 1);
  EXPECT_GE(left.states(), before);
  EXPECT_NEAR(left.summary["probes"][probe], last, 1e-6 * std::abs(last));
  measured(
      "{} | {} | {}; {} {:.4g}; {} states on disk without a NaN; `--restart` ends where the run did | {} | "
      "{} | | {}",
      extreme, value, left.summary["reason"].get<std::string>(), probe, last, before,
      totals["newton_iterations"].get<int>(), totals["krylov_iterations"].get<int>(),
      totals["cuts"].get<int>());
}

TEST(LeftOnDisk, PressureBeyondTheLimitPoint) {
  Left left(R"yaml(
mesh: {shell: {inner: 10, outer: 10.2, n: 4, layers: 1, part: octant}}
regions: {shell: {c10: 83.3 kPa}}
liquids: {inside: {surface: inner}}
symmetry: [x, y, z]
steps: [{name: blow, increments: 7, pressures: {inside: 5 kPa}}]
probes: [{name: pressure, kind: pressure, liquid: inside, unit: kPa}]
solver: {stepping: {minimum: 0.02}}
output: {checkpoint: 1}
)yaml");
  expect_left("pressure beyond the limit point, on disk", "5 kPa, limit 4.1 kPa", left, "pressure");
}

TEST(LeftOnDisk, SutureUpToLocalFailure) {
  Left left(R"yaml(
mesh: {shell: {inner: 10, outer: 12, n: 6, layers: 2, part: half}}
regions: {shell: {c10: 80 kPa}}
symmetry: [x]
fix: [{set: inner}]
rigid_bodies:
  tire: {tire: {width: 4, crown: 2, edge_radius: .5, inner_radius_of_curvature: 12, radius: 12, from: 0, to: 30}}
sutures:
  string: {body: tire, surface: outer, pair: {azimuth: 0, spacing: 8}, follow: true}
steps: [{name: sew, increments: 10, sew: {string: 20}}]
probes:
  - {name: force, kind: suture_force, suture: string}
  - {name: rise, kind: displacement, set: outer, component: y, statistic: max}
solver: {stepping: {minimum: 0.01}}
output: {checkpoint: 1}
)yaml");
  expect_left("suture force", "20 N, by steps of 2 N", left, "force");
}

}  // namespace
}  // namespace bulbus
