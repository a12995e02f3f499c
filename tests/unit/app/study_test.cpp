#include <gtest/gtest.h>

#include "tests/support/run_scene.hpp"
#include "tests/unit/app/studies.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;

TEST(Study, RunsEveryCombination) {
  const Study study = study_from(bar_study);
  EXPECT_EQ(study.combinations(), 6);
  EXPECT_EQ(levels_of(study), (std::vector<Levels>{{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}, {2, 1}}));
  const auto runs = plan(study);
  EXPECT_EQ(runs[5].name, "run_006");
  EXPECT_EQ(runs[5].scene.model.regions.at("block").c10, 1);
  EXPECT_EQ(*runs[5].scene.model.steps[0].displace[0].x, "0.8 mm");
  EXPECT_EQ(runs[5].scene.model.steps[0].increments, 1);
  EXPECT_EQ(words_of(study, runs[5].levels), "way 0.8 mm, c10 1 MPa");
  EXPECT_EQ(words_of(study, runs[5].levels, 0), "c10 1 MPa");
}

TEST(Study, VariesOneFactorAtATime) {
  const Study study = study_from(bar_study + "design: one_at_a_time\n");
  EXPECT_EQ(study.combinations(), 4);
  EXPECT_EQ(levels_of(study), (std::vector<Levels>{{1, 0}, {0, 0}, {2, 0}, {1, 1}}));
}

TEST(Study, FindsTheLinesOfEveryFactor) {
  Study study = study_from(replaced(bar_study, ".2, .4, .8", ".8, .2, .4"));
  const auto product = levels_of(study);
  auto lines = lines_along(0, study, product);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].runs, (std::vector<int>{2, 4, 0}));  // by rising value
  EXPECT_EQ(lines_along(1, study, product).size(), 3u);
  study.design = "one_at_a_time";
  lines = lines_along(1, study, levels_of(study));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].runs, (std::vector<int>{0, 3}));
}

TEST(Study, KnowsNumbersUnitsAndLabels) {
  const Study study = study_from(R"yaml(scene: bar.yaml
vary:
  - {name: a, keys: [title], values: [15 mmHg, 2e1 mmHg]}
  - {name: b, keys: [output.every], values: [1, 2 kPa]}
  - {name: c, keys: [x], values: ["2*t", 1]}
  - {name: d, keys: [y], values: [{c10: 1, terms: [{r: 2}]}, {c10: 2}], labels: [soft, stiff], baseline: stiff}
  - {name: e, keys: [z], values: [[x], [x, y], null]}
)yaml");
  const auto& f = study.vary;
  EXPECT_EQ(f[0].numbers(), (std::vector<double>{15, 20}));
  EXPECT_EQ(f[0].unit_text(), "mmHg");
  EXPECT_EQ(f[0].text(1), "20");
  for (int i : {1, 2, 3, 4}) EXPECT_TRUE(f[i].numbers().empty()) << i;
  EXPECT_EQ(f[1].text(1), "2 kPa");
  EXPECT_EQ(f[3].text(0), "soft");
  EXPECT_EQ(f[3].baseline_level(), 1);
  EXPECT_EQ(f[4].text(1), "[x, y]");
  EXPECT_EQ(f[4].text(2), "null");
}

TEST(Study, GivesBareNumbersTheirUnit) {
  const Study study = study_from(replaced(bar_study, "[0.5 MPa, 1 MPa]", "[500, 1000 kPa], unit: kPa"));
  EXPECT_EQ(study.vary[1].numbers(), (std::vector<double>{500, 1000}));
  const auto runs = plan(study);
  EXPECT_EQ(words_of(study, runs[5].levels), "way 0.8 mm, c10 1000 kPa");
  EXPECT_DOUBLE_EQ(runs[4].scene.model.regions.at("block").c10, .5);
  EXPECT_DOUBLE_EQ(runs[5].scene.model.regions.at("block").c10, 1);
}

TEST(Study, SavesNoFieldsUnlessAskedTo) {
  EXPECT_FALSE(plan(study_from(bar_study))[0].scene.output.vtk);
  EXPECT_TRUE(plan(study_from(bar_study, {"output.vtk=true"}))[0].scene.output.vtk);
  EXPECT_TRUE(
      plan(study_from(replaced(bar_study, "set: {", "set: {output.vtk: true, ")))[0].scene.output.vtk);
}

// A method has no use for a setting that another run of the study is about.
TEST(Study, ToleratesWhatSomeRunsDoNotUse) {
  const std::string study = R"yaml(scene: bar.yaml
vary:
  - {name: method, keys: [solver.linear.method], values: [direct, iterative]}
  - {name: restart, keys: [solver.linear.restart], values: [20, 30]}
)yaml";
  const auto runs = plan(study_from(study));
  ASSERT_EQ(runs.size(), 4u);
  EXPECT_EQ(runs[1].scene.solver.linear.restart, LinearSettings{}.restart);
  EXPECT_EQ(runs[3].scene.solver.linear.restart, 30);
  for (const StudyRun& run : runs) {
    const std::string text = resolved_yaml(run.scene);
    EXPECT_EQ(resolved_yaml(parse_scene(text, "resolved.yaml")), text);
  }
}

struct StudyFault {
  std::string from, to, message;
};

TEST(StudyErrors, NameLineRunAndRemedyBeforeAnythingIsWritten) {
  for (const StudyFault& f : std::vector<StudyFault>{
           {"scene: bar", "scene: baar", "study.yaml:2: scene: there is no file '"},
           {"vary:", "varry:", "study.yaml:4: unknown key 'varry'\n  did you mean 'vary'?"},
           {"stretch.displace", "strech.displace",
            "study.yaml:5: no entry 'strech' in a list of 1\n  did you mean 'stretch'?\n  in run_001: way "
            "0.2 mm, c10 0.5 MPa"},
           {"xmax.x]", "xmax.xx]", "study.yaml:5: unknown key 'xx' in steps.0.displace.0"},
           {"1 MPa]", "1 MPaa]", "study.yaml:6: regions.block.c10: "},
           {"1 MPa]", "1 mm]", "in run_002: way 0.2 mm, c10"},
           {".8], unit: mm", "\"0.8*q\"]", "study.yaml:5: steps.0.displace.0.x: "},
           {"increments: 1", "increments: 0", "study.yaml:3: steps.0.increments: '0' is out of bounds"},
           {".4, .8]", ".4, .40]", "study.yaml:5: vary.0: factor 'way': the value 0.4 is there twice"},
           {"[.2, .4, .8]", "[]", "study.yaml:5: vary.0: factor 'way': has no values"},
           {"baseline: .4", "baseline: .5", "the baseline '.5' is not among the values"},
           {"baseline: .4", "labels: [a, b]", "2 labels for 3 values"},
           {"name: c10", "name: way", "study.yaml:1: two factors are named 'way'"},
           {"regions.block.c10]", "steps.stretch.displace.xmax.x]", "is varied twice"},
           {"regions.block.c10]", "steps.0.displace.0.x]",
            "study.yaml:6: the key 'steps.0.displace.0.x' is varied twice: 'steps.stretch.displace.xmax.x' "
            "is "
            "the same, or a part of it"},
           {"regions.block.c10]", "steps.0.displace.0]",
            "study.yaml:6: the key 'steps.0.displace.0' is varied"},
           {"set: {", "set: {steps.0.displace.0.x: 3, ",
            "study.yaml:3: set: 'steps.0.displace.0.x' has no effect: the study varies 'steps.stretch."},
           {"set: {", "set: {steps.0.increments: 3, ",
            "study.yaml:3: set: 'steps.stretch.increments' overwrites 'steps.0.increments'"},
           {"unit: mm", "unit: mmHg", "study.yaml:5: steps.0.displace.0.x: 'mmHg' is not a unit that fits"},
           {"1 MPa]", "1 MPa], unit: kPa",
            "study.yaml:6: vary.1: factor 'c10': the value 0.5 MPa is no number in kPa"},
           {"1 MPa]", "t], unit: MPa", "study.yaml:6: vary.1: factor 'c10': the value t is no number in MPa"},
           {"title: a bar", "figures: [pull, stres]",
            "study.yaml:1: figures: there is no probe 'stres'\n  did you mean 'stress'?"},
           {"set: {", "set: {solver.linear.gamma: 8, ",
            "study.yaml:3: solver.linear.gamma: has no effect: solver.linear.method is direct\n  Leave it "
            "out, "
            "or choose iterative for solver.linear.method.\n  in run_001"},
           {"title: a bar", "design: all", "study.yaml:1: design: 'all' is not among the choices"},
           {"regions.block.c10], values: [0.5 MPa, 1 MPa]", "probes.pull.unit], values: [mN, N]",
            "figures: 'pull' is another figure, or in another unit"}}) {
    for (const char* command : {"study", "check"}) {
      const Ran r = run_a_study(replaced(bar_study, f.from, f.to), {}, command);
      EXPECT_EQ(r.status, 2) << f.to;
      EXPECT_NE(r.err.find(f.message), std::string::npos) << f.to << ": " << r.err;
      EXPECT_FALSE(std::filesystem::exists(r.folder / "out"));
    }
  }
}

TEST(StudyErrors, TellAStudyFromAScene) {
  EXPECT_NE(run_a_study(bar_scene).err.find("study.yaml: is no study: it has neither 'scene' nor 'vary'"),
            std::string::npos);
  EXPECT_NE(run_a_study(bar_study, {}, "run").err.find("study.yaml: is a study, not a scene"),
            std::string::npos);
}

TEST(StudyErrors, PlaceAFaultOfTheScene) {
  bar_folder();
  std::ofstream(std::filesystem::temp_directory_path() / "bulbus_study" / "bar.yaml")
      << replaced(bar_scene, "unit: mN", "unit: mmHg");
  const Ran r = run_study_again(bar_study);
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("bar.yaml:12: probes.0.unit: "), std::string::npos) << r.err;
}

TEST(StudyErrors, RefuseWhatAnOverrideCannotMean) {
  const Ran r = run_a_study(bar_study, {"regions.block.c10=2"});
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("--set regions.block.c10=2: the study varies this key"), std::string::npos) << r.err;
  const Ran other = run_a_study(bar_study, {"steps.0.displace.0.x=.3"}, "check");
  EXPECT_EQ(other.status, 2);
  EXPECT_NE(other.err.find("--set steps.0.displace.0.x=.3: the study varies this key"), std::string::npos)
      << other.err;
  EXPECT_EQ(run_a_study(bar_study, {"steps.0.displace.0.y=0"}, "check").status, 0);
}

}  // namespace
