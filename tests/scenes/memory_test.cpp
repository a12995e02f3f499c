// What a run is said to need, and what it takes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/process.hpp"

namespace bulbus {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Memory {
  double forecast = 0, fallback = 0, peak = 0;  // MB
};

// A small indentation of the half eye, in a process of its own.
Memory of_half_eye(const std::vector<std::string>& settings) {
  const fs::path out = fs::temp_directory_path() / ("bulbus_memory_" + std::to_string(getpid()));
  std::vector<std::string> arguments{BULBUS_PROGRAM, "run", BULBUS_DATA "/scenes/half_eye.yaml", "-o", out};
  for (const char* s : {"steps.1.displace.0.radial=-.1", "steps.1.increments=1", "output.checkpoint=1"})
    arguments.insert(arguments.end(), {"--set", s});
  for (const std::string& s : settings) arguments.insert(arguments.end(), {"--set", s});
  EXPECT_EQ(run_process(arguments).status, 0);
  std::ifstream file(out / "summary.json");
  const json memory = json::parse(file)["memory_mb"];
  fs::remove_all(out);
  return {memory["forecast"]["together"], memory["forecast"]["fallback"],
          memory["process_peak"]["all_ranks"]};
}

TEST(Memory, OfAnEyeIsForecast) {
  const Memory m = of_half_eye({"mesh.eye.n=14"});
  EXPECT_NEAR(m.forecast, m.peak, .15 * m.peak);
}

TEST(Memory, OfAnEyeRefinedTwiceIsForecast) {
  const Memory m = of_half_eye({"mesh.eye.n=6", "mesh.refine=2"});
  EXPECT_NEAR(m.forecast, m.peak, .15 * m.peak);
}

TEST(Memory, OfARefinedEyeIsForecast) {
  const Memory m = of_half_eye({"mesh.eye.n=10", "mesh.refine=1"});
  EXPECT_NEAR(m.forecast, m.peak, .15 * m.peak);
}

// Its solves are easy: there are no tight ones and no Schur-complement correction.
TEST(Memory, OfALooseBalanceIsForecast) {
  const Memory m = of_half_eye({"mesh.eye.n=10", "mesh.refine=1", "solver.newton.force=1e-3",
                                "solver.newton.volume=1e-3", "solver.newton.liquid=1e-5"});
  EXPECT_NEAR(m.forecast, m.peak, .15 * m.peak);
}

// Five iterations are too few for GMRES.
TEST(Memory, OfMumpsAsTheLastResortIsForecast) {
  const Memory m = of_half_eye({"mesh.eye.n=14", "solver.linear.max_iterations=5"});
  EXPECT_GT(m.fallback, m.forecast);
  EXPECT_NEAR(m.forecast + m.fallback, m.peak, .15 * m.peak);
}

TEST(Memory, IsForecastWithoutALastResortWhereThereIsNone) {
  EXPECT_EQ(of_half_eye({"mesh.eye.n=8", "solver.linear.fallback=none"}).fallback, 0);
}

}  // namespace
}  // namespace bulbus
