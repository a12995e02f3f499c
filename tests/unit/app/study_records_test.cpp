#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/study/study_figure.hpp"
#include "app/study/study_json.hpp"
#include "tests/unit/app/studies.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;
using CourseKind = Course::Kind;

Course course(const std::vector<double>& values) { return course_of(values, 1e-3); }

TEST(Course, RisesFallsOrTurns) {
  EXPECT_EQ(course({}).kind, CourseKind::unknown);
  EXPECT_EQ(course({1}).kind, CourseKind::unknown);
  EXPECT_EQ(course({1, 2, 2, 3}).kind, CourseKind::rising);
  EXPECT_EQ(course({3, -1}).kind, CourseKind::falling);
  EXPECT_EQ(course({0, 0}).kind, CourseKind::constant);
  EXPECT_EQ(course({1000, 1000.5, 999.6}).kind, CourseKind::constant);
  EXPECT_EQ(course({1000, 1010, 1009.5, 1020}).kind, CourseKind::rising);
  const Course wave = course({1, 3, 3, 2, 4});
  EXPECT_EQ(wave.kind, CourseKind::mixed);
  EXPECT_EQ(wave.turns, (std::vector<int>{1, 3}));
}

/// Six runs with two figures: pull rises with way but for its last value at c10 1, which did not converge;
/// the run before the last is still to do.
StudyResults results_of(const Study& study) {
  StudyResults results{{{"pull", "mN"}, {"stress", "MPa"}}, {}, levels_of(study), {}};
  for (int run = 0; run < 6; ++run) {
    results.runs.push_back("run_00" + std::to_string(run + 1));
    results.rows.push_back(StudyRow{true, "", {10. * run, 3. - run % 2}, 4, 20, 1.5});
  }
  results.rows[3]->values = {100, {}};
  results.rows[4].reset();
  results.rows[5]->converged = false;
  results.rows[5]->reason = "too far, it \"says\"";
  return results;
}

TEST(StudyRecords, WriteATable) {
  const Study study = study_from(bar_study);
  const std::string file = bar_folder() / "study.csv";
  write_study_csv(file, study, results_of(study));
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(text,
            "run,way [mm],c10 [MPa],converged,reason,pull [mN],stress "
            "[MPa],newton_iterations,krylov_iterations,seconds\n"
            "run_001,0.2,0.5,true,,0,3,4,20,1.5\n"
            "run_002,0.2,1,true,,10,2,4,20,1.5\n"
            "run_003,0.4,0.5,true,,20,3,4,20,1.5\n"
            "run_004,0.4,1,true,,100,,4,20,1.5\n"
            "run_006,0.8,1,false,\"too far, it \"\"says\"\"\",50,2,4,20,1.5\n");
}

TEST(StudyRecords, ShowTheTableAndMarkWhatFailed) {
  const Study study = study_from(bar_study);
  const auto lines = lines_of(study, results_of(study));
  ASSERT_EQ(lines.size(), 2 + 5 + 1u);
  for (int i = 1; i < 7; ++i) EXPECT_EQ(lines[i].size(), lines[0].size());
  EXPECT_NE(lines[0].find("pull"), std::string::npos);
  EXPECT_NE(lines[1].find("mN"), std::string::npos);
  EXPECT_NE(lines[5].find(" - "), std::string::npos);
  EXPECT_NE(lines[6].find("50*"), std::string::npos);
  EXPECT_EQ(lines[7], "* run_006 did not converge, last good figures: too far, it \"says\"");
}

TEST(StudyRecords, BreakWideTablesIntoBlocks) {
  const std::string wide(70, 'x');
  const auto lines = aligned({{"a", "1"}, {wide, "µ"}, {wide, "3"}}, 1);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0], "  a  " + wide);
  EXPECT_EQ(lines[1], "  1  " + std::string(69, ' ') + "µ");
  EXPECT_EQ(lines[2], "");
  EXPECT_EQ(lines[3], lines[0]);
}

TEST(StudyRecords, TellTrendsOfWhatConverged) {
  const Study study = study_from(bar_study);
  StudyResults results = results_of(study);
  auto trends = trends_of(study, results);
  EXPECT_EQ(trends.size(), 2u * (2 + 3));
  EXPECT_EQ(words_of(study, results, trends[0]), "rising");  // pull along way at c10 0.5: two of three runs
  EXPECT_EQ(trends[0].runs, (std::vector<int>{0, 2}));
  EXPECT_EQ(words_of(study, results, trends[1]), "constant");
  results.rows[5]->converged = true;
  trends = trends_of(study, results);
  EXPECT_EQ(words_of(study, results, trends[2]), "not monotone: turns at 0.4");
  const auto lines = lines_of(study, results, trends);
  EXPECT_TRUE(std::ranges::any_of(lines, [](const auto& line) {
    return line.starts_with("('rising 2, falling 1': ");
  })) << "lines differ: that is explained";
  EXPECT_EQ(lines.back(), "pull in way (c10 1 MPa) is not monotone: turns at 0.4");
  const auto s = json_of(study, results, trends);
  EXPECT_EQ(s["trends"][2]["course"], "not monotone");
  EXPECT_EQ(s["trends"][2]["turns"], nlohmann::json::array({.4}));
  EXPECT_EQ(s["trends"][2]["others"], (nlohmann::json{{"c10", 1}}));
  EXPECT_EQ(s["runs"].size(), 5u);
  EXPECT_TRUE(s["runs"][3]["probes"]["stress"].is_null());
  EXPECT_EQ(s["factors"][1]["unit"], "MPa");
}

TEST(StudyFigure, HasAPanelPerFigureAndACurvePerOtherLevels) {
  const Study study = study_from(bar_study);
  const Chart chart = chart_of(study, results_of(study));
  ASSERT_EQ(chart.panels.size(), 2u);
  const Chart::Panel& pull = chart.panels[0];
  EXPECT_EQ(pull.title, "pull [mN]");
  EXPECT_EQ(pull.x_label, "way [mm]");
  ASSERT_EQ(pull.series.size(), 2u);
  EXPECT_EQ(pull.series[1].name, "c10 1 MPa");
  ASSERT_EQ(pull.series[1].marks.size(), 3u);
  EXPECT_EQ(pull.series[1].marks[2].x, .8);
  EXPECT_TRUE(pull.series[1].marks[1].solid);
  EXPECT_FALSE(pull.series[1].marks[2].solid);
  EXPECT_NE(chart.note.find("hollow"), std::string::npos);
}

TEST(StudyFigure, HasAPanelPerFactorOneAtATime) {
  const Study study = study_from(bar_study + "design: one_at_a_time\n");
  StudyResults results{{{"pull", "mN"}}, {"a", "b", "c", "d"}, levels_of(study), {}};
  for (double y : {1, 2, 3, 4}) results.rows.push_back(StudyRow{true, "", {y}});
  const Chart chart = chart_of(study, results);
  ASSERT_EQ(chart.panels.size(), 2u);
  EXPECT_EQ(chart.panels[1].x_label, "c10 [MPa]");
  EXPECT_EQ(chart.panels[1].series.size(), 1u);
  EXPECT_EQ(chart.note, "baseline: way 0.4 mm, c10 0.5 MPa");
}

}  // namespace
