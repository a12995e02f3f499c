// What `accuracy` promises in its help, on the operation's figures with a coarse eye.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/command_line.hpp"
#include "app/trade/trade_results.hpp"
#include "tests/support/not_empty.hpp"

namespace bulbus {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string interactions = std::string(BULBUS_DATA) + "/scenes/encircling.yaml";
const std::vector<std::string> coarse{"--set", "mesh.eye.n=8", "--set", "output.vtk=false"};

/// The summary of a run.
json run_with(const std::vector<std::string>& settings) {
  const fs::path out = fs::temp_directory_path() / ("bulbus_accuracy_" + std::to_string(getpid()));
  std::vector<std::string> arguments{"run", interactions, "-o", out};
  arguments.insert(arguments.end(), coarse.begin(), coarse.end());
  for (const std::string& s : settings) arguments.insert(arguments.end(), {"--set", s});
  std::ostringstream said, faults;
  EXPECT_EQ(command_line(arguments, Comm(MPI_COMM_SELF), said, faults), 0) << faults.str();
  std::ifstream file(out / "summary.json");
  const json summary = json::parse(file);
  fs::remove_all(out);
  return summary;
}

const json& tight() {
  static const json summary = run_with({});
  return summary;
}

void expect_within(const json& run, const json& reference, double promised) {
  const json &got = run["probes"], &right = reference["probes"];
  const Scene scene = read_scene(interactions);
  for (const ProbeSpec& probe : not_empty(scene.model.probes)) {
    const double value = got[probe.name], wanted = right[probe.name];
    EXPECT_LE(relative_error(value, wanted, least_of(probe)), promised)
        << probe.name << " " << value << " instead of " << wanted;
  }
  EXPECT_EQ(got["tear_closed"], right["tear_closed"]);
  EXPECT_NEAR(got["axial_length"], right["axial_length"], .01);  // mm
  EXPECT_NEAR(got["IOP"], right["IOP"], .1);                     // mmHg
  for (const auto& [name, contact] : not_empty(reference["contacts"]).items())
    EXPECT_EQ(run["contacts"][name]["active_nodes"], contact["active_nodes"]) << name;
}

TEST(Accuracy, TightIsConverged) {
  expect_within(
      tight(),
      run_with({"solver.newton.force=1e-9", "solver.newton.volume=1e-9", "solver.newton.liquid=1e-10"}),
      1e-4);
}

// Whatever the augmentation, the system has one solution: γ changes the iterates of GMRES and with them the
// path of Newton's method. No such path may end with another node in contact, nor beyond what is promised.
const std::vector<std::string> paths{"solver.linear.gamma=3", "solver.linear.gamma=5",
                                     "solver.linear.gamma=12"};

TEST(Accuracy, BalancedIsWithinTwoInAThousand) {
  for (const std::string& gamma : paths)
    expect_within(run_with({"solver.accuracy=balanced", gamma}), tight(), 2e-3);
}

TEST(Accuracy, FastIsWithinTwoInAHundred) {
  for (const std::string& gamma : paths)
    expect_within(run_with({"solver.accuracy=fast", gamma}), tight(), 2e-2);
}

}  // namespace
}  // namespace bulbus
