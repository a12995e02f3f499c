// The small half eye: nothing done to it, a deep buckle and back, a retina far off its bed, zonules slack and
// cut.
#include "core/base/error.hpp"
#include "tests/extremes/run.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

constexpr int n = 6;

/// The small eye whose band is pushed in by `depth`, mm.
Scene pushed(Scene eye, double depth, int increments) {
  StepSpec& s = eye.model.steps[1];
  s.increments = increments;
  s.displace[0].radial = fmt::format("{:.17g}", -depth);
  return held_band(eye);
}

double mmHg(double MPa) { return MPa / 1.33322e-4; }

double off(const Trial& run, const State& from) {
  const auto u = plus(from.x, -1, run.problem.mesh().X);
  return largest(plus(run.state.x, -1, from.x)) / largest(u);
}

TEST(Eye, NoLoadAtAll) {
  Scene eye = small_eye(n);
  eye.model.steps = {step("nothing", 3)};
  eye.model.steps[0].enclose = {"vitreous"};
  Trial run(eye);
  run.settings.newton = {};
  run.iterative();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  expect_clean(run);
  const double moved = largest(plus(run.state.x, -1, run.problem.mesh().X));
  row("no load", "eye", run, "moves by {:g} mm, pressure {:g} MPa", moved, run.state.P[0]);
  EXPECT_EQ(moved, 0);
  EXPECT_EQ(run.state.P[0], 0);
}

TEST(Eye, DeepBuckleAndBackAgain) {
  Scene eye = pushed(small_eye(n), 3.5, 8);
  StepSpec back = eye.model.steps[1];
  back.name = "back";
  back.displace[0].radial = "3.5";
  eye.model.steps.push_back(back);
  Trial run(eye);
  run.settings.newton = close_balance();
  State filled, deepest;
  run.watch = [&](const Increment& i, const State& s) {
    if (i.time == 1) filled = s;
    if (i.time == 2) deepest = s;
  };
  run.iterative();
  expect_clean(run);
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  row("buckle", "3.5 mm, and back", run,
      "{:.1f} mmHg at its deepest; afterwards {:.0e} of the displacements away from the eye before, {:.3f} "
      "mmHg",
      mmHg(deepest.P[0]), off(run, filled), mmHg(run.state.P[0]));
  EXPECT_GT(deepest.P[0], 2 * filled.P[0]);
  EXPECT_LT(off(run, filled), 1e-5);
}

/// The eye with its retina lifted by `height`, mm, and torn, under 15 mmHg and a buckle of 2 mm.
Scene lifted(double height) {
  EyeSettings settings;
  settings.n = 8;
  settings.detachment = Detachment{.height = height, .tear = Tear{.center = 98}};
  Scene eye = pushed(small_eye(n), 2, 4);
  eye.mesh = generate(settings);
  eye.model.contacts = {contact_between("retina", "retina_back", "retina_bed")};
  return eye;
}

TEST(Eye, RetinaFarOffItsBed) {
  std::vector<double> pressures;
  for (double height : {1., 3.}) {
    ContactTrial run(lifted(height));
    as_people_do(run, .02);
    ASSERT_TRUE(run.report.converged) << run.report.reason;
    EXPECT_EQ(run.report.cuts, 0);
    EXPECT_GT(run.pairs("retina"), 0);
    pressures.push_back(run.state.P[0]);
    row("lift of the retina", fmt::format("{:g} mm, buckle 2 mm", height), run,
        "{:.1f} mmHg, {} nodes of the retina touch", mmHg(run.state.P[0]), run.pairs("retina"));
  }
  EXPECT_LT(relative(pressures[0], pressures[1]), .01) << "the liquid on both sides is one";
}

/// The eye at 15 mmHg and pushed in by 1 mm; its zonules may only pull, or are cut.
Scene hung(const std::string& zonules) {
  Scene eye = pushed(small_eye(n), 1, 2);
  auto& bars = eye.mesh.bars.at("zonules");
  if (zonules == "half of them cut") bars.resize(bars.size() / 2);
  if (zonules == "all cut") eye.model.bars.clear(), eye.mesh.bars.clear();
  if (zonules != "as drawn" && zonules != "all cut") eye.model.bars["zonules"].tension_only = true;
  if (zonules == "slack") {  // the band beneath their ends comes in: they push unless they go slack
    eye.model.steps.erase(eye.model.steps.begin());
    eye.model.steps[0].displace[0].from = "reference";
  }
  return eye;
}

std::vector<double> zonule_forces(const Trial& run) {
  return run.problem.bars().at("zonules")->bars().forces(run.state.x);
}

TEST(Eye, ZonulesSlackAndCut) {
  std::map<std::string, double> least, pressure;  // smallest force of a zonule, N, and the liquid's, mmHg
  for (const std::string zonules : {"as drawn", "pull only", "slack", "half of them cut"}) {
    Trial run(hung(zonules));
    as_people_do(run, .05);
    ASSERT_TRUE(run.report.converged) << run.report.reason;
    EXPECT_EQ(run.report.cuts, 0) << zonules;
    least[zonules] = std::ranges::min(zonule_forces(run));
    pressure[zonules] = mmHg(run.state.P[0]);
    row("zonules", zonules, run, "{:.2f} mmHg, largest displacement {:.3g} mm", mmHg(run.state.P[0]),
        largest(plus(run.state.x, -1, run.problem.mesh().X)));
  }
  EXPECT_LT(least["as drawn"], 0);
  for (const char* zonules : {"pull only", "slack", "half of them cut"})
    EXPECT_EQ(least[zonules], 0) << zonules;
  EXPECT_LT(pressure["pull only"], pressure["as drawn"]);
  EXPECT_LT(pressure["half of them cut"], pressure["pull only"]);
  EXPECT_LT(pressure["slack"], 15);
}

TEST(Eye, AFloatingLensIsRefused) {
  try {
    Trial run(hung("all cut"));
    FAIL() << "solved a lens that nothing holds";
  } catch (const InputError& e) {
    const std::string text = e.what(), first = text.substr(0, text.find('\n'));
    EXPECT_NE(text.find("(lens)"), std::string::npos) << text;
    measured("zonules | all cut | refused: {} | | | |", first);
  }
}

}  // namespace
}  // namespace bulbus
