#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/records/finished.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/support/run_scene.hpp"
#include "tests/unit/app/studies.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;
namespace fs = std::filesystem;
using nlohmann::json;

// The bar stands 0.1 mm of its 2 mm, not less than nothing.
const std::string failing = replaced(bar_study, "[.2, .4, .8], unit: mm", "[\"-2.2*s\", .4]");

/// W = c10 (I1 − 3) under tension: the pull on the whole section 2 × 2 is 8 c10 (l − 1/l²).
TEST(StudyRun, WritesTableFigureAndTrends) {
  const Ran r = run_a_study(bar_study);
  ASSERT_EQ(r.status, 0) << r.err;
  const json s = json::parse(r.text("study.json"));
  ASSERT_EQ(s["runs"].size(), 6u);
  const double l = 1.2;
  EXPECT_NEAR(s["runs"][3]["probes"]["pull"], 8e3 * (l - 1 / (l * l)), 1e-2);
  for (const auto& trend : not_empty(s["trends"])) EXPECT_EQ(trend["course"], "rising");
  EXPECT_EQ(s["trends"].size(), 10u);
  for (const char* file :
       {"study.csv", "study.svg", "study.log", "run_006/summary.json", "run_006/history.csv"})
    EXPECT_TRUE(r.wrote(file)) << file;
  EXPECT_FALSE(r.wrote("run_001/result.hdf.series"));
  EXPECT_NE(r.text("study.log").find("6 of 6 runs converged"), std::string::npos);
}

TEST(StudyRun, GoesOnAfterARunThatFails) {
  const Ran r = run_a_study(replaced(failing, "baseline: .4", "labels: [crushed, pulled]"));
  EXPECT_EQ(r.status, 1) << r.err;
  const json s = json::parse(r.text("study.json"));
  ASSERT_EQ(s["runs"].size(), 4u);
  EXPECT_EQ(s["runs"][0]["converged"], false);
  EXPECT_NE(s["runs"][0]["reason"].get<std::string>().find("stretch"), std::string::npos);
  EXPECT_EQ(s["runs"][3]["converged"], true);
  EXPECT_NE(r.text("study.csv").find("run_001,crushed,0.5,false,"), std::string::npos);
  EXPECT_NE(r.text("study.svg").find("fill=\"white\" stroke=\"#0072b2\""), std::string::npos);
  EXPECT_NE(r.text("study.log").find("* run_001 did not converge"), std::string::npos);
}

TEST(StudyRun, TakesUpWhereItWasLeft) {
  const Ran first = run_a_study(failing);
  ASSERT_EQ(first.status, 1) << first.err;
  const auto written = [&](const char* run) {
    return fs::last_write_time(first.folder / "out" / run / "summary.json");
  };
  const auto kept = written("run_001"), changed = written("run_004");
  fs::remove(first.folder / "out" / "run_003" / "summary.json");
  const Ran again = run_study_again(replaced(failing, "1 MPa]", "2 MPa]"));
  EXPECT_EQ(again.status, 1) << again.err;
  EXPECT_EQ(written("run_001"), kept);
  EXPECT_TRUE(again.wrote("run_003/summary.json"));
  EXPECT_GT(written("run_004"), changed);
  EXPECT_NE(again.text("study.log").find("run_001 is there already"), std::string::npos);
  EXPECT_EQ(again.text("study.log").find("run_002 is there already"), std::string::npos);
}

// It may end otherwise on the machine, or with the limit, that it is started on next.
TEST(StudyRun, RepeatsARunThatRanOutOfMemory) {
  const Ran first = run_a_study(failing);
  ASSERT_EQ(first.status, 1) << first.err;
  const fs::path file = first.folder / "out/run_001/summary.json";
  json summary = summary_in(first.folder / "out/run_001");
  ASSERT_EQ(summary["converged"], false);
  summary["reason"] = "step 'stretch' stopped at 0.5 of its way: out of memory: refine the mesh less";
  std::ofstream(file) << summary;
  const Ran again = run_study_again(failing);
  EXPECT_EQ(again.text("study.log").find("run_001 is there already"), std::string::npos);
  EXPECT_NE(again.text("study.log").find("run_002 is there already"), std::string::npos);
  EXPECT_EQ(summary_in(first.folder / "out/run_001")["reason"].get<std::string>().find("memory"),
            std::string::npos);
}

/// Their resolved.yaml says what the regions got, not only which materials they are of.
TEST(StudyRun, FindsRunsOfMaterialsAgain) {
  const auto scene = replaced(replaced(bar_scene, "{upper", "{region: ciliary_body, upper"),
                              "regions:\n  block: {c10: 0.5}", "materials: paper");
  const auto study = replaced(bar_study, "keys: [regions.block.c10], values: [0.5 MPa, 1 MPa]",
                              "keys: [materials], values: [paper, physiological]");
  std::ofstream(bar_folder() / "bar.yaml") << scene;
  const Ran first = run_study_again(study);
  ASSERT_EQ(first.status, 0) << first.err;
  const json runs = json::parse(first.text("study.json"))["runs"];
  const double paper = runs[0]["probes"]["pull"], physiological = runs[1]["probes"]["pull"];
  EXPECT_NEAR(physiological, 6 * paper, 1e-4 * paper);
  const Ran again = run_study_again(replaced(study, "physiological]", "stiff_lens]"));
  ASSERT_EQ(again.status, 0) << again.err;
  for (const char* run : {"run_001", "run_003", "run_005"})
    EXPECT_NE(again.text("study.log").find(std::string(run) + " is there already"), std::string::npos) << run;
  EXPECT_EQ(again.text("study.log").find("run_002 is there already"), std::string::npos);
}

TEST(StudyRun, DumpsEveryRunIntoItsOwnFolder) {
  const Ran r = run_a_study(bar_study, {"solver.linear.dump=systems"});
  ASSERT_EQ(r.status, 0) << r.err;
  for (int run = 1; run <= 6; ++run)
    EXPECT_TRUE(r.wrote("run_00" + std::to_string(run) + "/systems/system_0001.h5")) << run;
}

TEST(StudyRun, ChecksWithoutSolving) {
  const Ran r = run_a_study(bar_study, {}, "check");
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(std::distance(fs::directory_iterator(r.folder), fs::directory_iterator()), 2);
}

TEST(StudyRun, ReadsTheStudiesOfTheProject) {
  int studies = 0;
  for (const auto& entry : fs::directory_iterator(BULBUS_DATA "/scenes"))
    if (entry.path().filename().string().starts_with("study_")) {
      const Study study = read_study(entry.path());
      const auto runs = plan(study);
      EXPECT_GT(runs.size(), 1u) << entry.path();
      EXPECT_FALSE(figures_of(study, runs).empty()) << entry.path();
      ++studies;
    }
  EXPECT_GT(studies, 0);
}

}  // namespace
