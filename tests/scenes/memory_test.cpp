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

// In a process of its own.
Memory of_scene(const std::string& name, const std::vector<std::string>& settings) {
  const fs::path out = fs::temp_directory_path() / ("bulbus_memory_" + std::to_string(getpid()));
  std::vector<std::string> arguments{BULBUS_PROGRAM, "run", BULBUS_DATA "/scenes/" + name + ".yaml", "-o",
                                     out};
  for (const std::string& s : settings) arguments.insert(arguments.end(), {"--set", s});
  EXPECT_EQ(run_process(arguments).status, 0);
  std::ifstream file(out / "summary.json");
  const json memory = json::parse(file)["memory_mb"];
  fs::remove_all(out);
  return {memory["forecast"]["together"], memory["forecast"]["fallback"],
          memory["process_peak"]["all_ranks"]};
}

// A small indentation.
Memory of_half_eye(std::vector<std::string> settings) {
  for (const char* s : {"steps.1.displace.0.radial=-.1", "steps.1.increments=1", "output.checkpoint=1"})
    settings.push_back(s);
  return of_scene("half_eye", settings);
}

// Sutures that follow the tissue and deformable masters make the tangent unsymmetric: both triangles, L U.
Memory of_operation(const std::string& method) {
  return of_scene("encircling", {"mesh.eye.n=8", "solver.accuracy=fast", "solver.linear.method=" + method});
}

TEST(Memory, OfAnOperationIsForecast) {
  for (const char* method : {"iterative", "direct"}) {
    const Memory m = of_operation(method);
    EXPECT_NEAR(m.forecast, m.peak, .15 * m.peak) << method;
  }
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
