// A study on any number of ranks: the same figures, written once.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/command_line.hpp"
#include "tests/support/not_empty.hpp"

namespace bulbus {
namespace {

TEST(Study, IsWrittenByOneRank) {
  const Comm comm;
  const auto folder =
      std::filesystem::temp_directory_path() / ("bulbus_study_" + std::to_string(comm.size()));
  if (comm.rank() == 0) std::filesystem::remove_all(folder);
  comm.barrier();
  const std::vector<std::string> study{"study", BULBUS_DATA "/scenes/study_sphere.yaml", "-o", folder};
  EXPECT_EQ(command_line(study, comm, std::cout, std::cerr), 0);
  EXPECT_EQ(command_line(study, comm, std::cout, std::cerr), 0);  // all there already
  if (comm.rank() != 0) return;
  std::ifstream in(folder / "study.json");
  const auto s = nlohmann::json::parse(in);
  ASSERT_EQ(s["runs"].size(), 6u);
  EXPECT_NEAR(s["runs"][0]["probes"]["pressure"], 19.826013, 1e-5);
  EXPECT_NEAR(s["runs"][5]["probes"]["pressure"], 53.533026, 1e-5);
  for (const auto& trend : not_empty(s["trends"]))
    EXPECT_EQ(trend["course"],
              trend["factor"] == "c10" && trend["figure"] == "outer_radius" ? "falling" : "rising");
}

}  // namespace
}  // namespace bulbus
