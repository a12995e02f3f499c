// Contact with penalties far from the default, and a load that comes and goes.
#include "tests/extremes/run.hpp"
#include "tests/verify/two_blocks.hpp"

namespace bulbus {
namespace {

/// The upper block on a wider, nearly rigid one whose nodes do not match.
Scene on_a_stiff_block(double penalty) {
  Scene scene = two_blocks(4, 3, penalty, 0, 1.3);
  scene.model.regions["low"] = neo_hooke(1e4 * block_c10);
  return scene;
}

double default_penalty(const Scene& scene) {
  return ContactTrial(scene).interactions->contact("joint", "").penalty;
}

/// Nominal stress of the upper block, 0.5 high and pressed by 0.1, where the penalty lets it sink in by g: α
/// g = −P(0.8 + 2 g).
double on_springs(double alpha) {
  double g = 0;
  for (int i = 0; i < 50; ++i)
    g -= (alpha * g + uniaxial(.8 + 2 * g)) / (alpha + 4 * block_c10 * (1 + 2 / std::pow(.8 + 2 * g, 3)));
  return uniaxial(.8 + 2 * g);
}

void record(const std::string& extreme, double times, bool iterative, ContactTrial& run, double off) {
  const std::string value = fmt::format("{:g}{}", times, iterative ? "" : ", direct");
  if (!run.report.converged) return row(extreme, value, run, "{} increments done", run.report.increments);
  row(extreme, value, run, "force off by {:.0e} of the closed form with this penalty; penetration {:.1e} mm",
      off, run.contact("joint").figures(run.state).penetration);
}

TEST(Contact, PenaltyFarFromItsDefault) {
  const double usual = default_penalty(on_a_stiff_block(0));
  for (bool iterative : {true, false})
    for (double times : {1e-3, 1., 10., 1e2, 1e4}) {
      ContactTrial run(on_a_stiff_block(times * usual));
      run.settings.newton = {}, run.settings.stepping.smallest = .2;
      iterative ? run.iterative() : run.direct();
      expect_clean(run);
      const double off = relative(run.force("joint")[2], on_springs(times * usual));
      record("contact penalty, times its default", times, iterative, run, off);
      if (run.report.converged) {
        EXPECT_LT(off, .02);
      }
      EXPECT_TRUE(iterative || run.report.converged);
    }
}

// Each node lies on an edge or a corner of the other side, so that its pair may change with round-off.
TEST(Contact, NodesThatMatch) {
  const double usual = default_penalty(two_blocks(3, 3, 0));
  for (bool iterative : {true, false})
    for (double times : {1., 10., 1e4}) {
      ContactTrial run(two_blocks(3, 3, times * usual));
      run.settings.newton = {}, run.settings.stepping.smallest = .2;
      iterative ? run.iterative() : run.direct();
      EXPECT_TRUE(std::isfinite(largest(run.state)));
      EXPECT_EQ(run.report.converged, run.report.reason.empty());
      const double off = relative(run.force("joint")[2], with_penalty(times * usual));
      record("contact of matching nodes, penalty times its default", times, iterative, run, off);
      if (run.report.converged) {
        EXPECT_LT(off, 1e-3);
      }
      EXPECT_TRUE(iterative || run.report.converged);
    }
}

}  // namespace
}  // namespace bulbus
