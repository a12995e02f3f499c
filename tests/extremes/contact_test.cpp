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

/// What a run came to.
struct Outcome {
  double force;  ///< of the slave on the master, N
  int newton_iterations;
};

/// One row: the scene by one of the solvers, to the default balance. It converges without a cut, at the force
/// `exact` of the closed form.
Outcome pressed(const std::string& extreme, double times, const Scene& scene, bool iterative, double exact,
                double tolerance) {
  ContactTrial run(scene);
  run.settings.newton = {}, run.settings.stepping.minimum = .2;
  iterative ? run.iterative() : run.direct();
  expect_clean(run);
  const double force = run.force("joint")[2], off = relative(force, exact);
  row(extreme, fmt::format("{:g}{}", times, iterative ? "" : ", direct"), run,
      "force off by {:.0e} of the closed form with this penalty; penetration {:.1e} mm", off,
      run.contact("joint").figures(run.state).penetration);
  EXPECT_TRUE(run.report.converged) << run.report.reason;
  EXPECT_EQ(run.report.cuts, 0) << times;
  EXPECT_LT(off, tolerance) << times;
  EXPECT_EQ(most_krylov(run) > 0, iterative);
  return {force, run.report.newton_iterations};
}

/// Rows of all penalties by GMRES, then by MUMPS: both end at one force, in about as many Newton iterations.
void by_both_solvers(const std::string& extreme, const std::vector<double>& penalties,
                     const std::function<Scene(double)>& scene, const std::function<double(double)>& exact,
                     double tolerance) {
  std::vector<Outcome> found;
  for (double times : penalties)
    found.push_back(pressed(extreme, times, scene(times), true, exact(times), tolerance));
  for (std::size_t i = 0; i < penalties.size(); ++i) {
    const double times = penalties[i];
    const Outcome direct = pressed(extreme, times, scene(times), false, exact(times), tolerance);
    EXPECT_LT(relative(found[i].force, direct.force), 1e-5) << times;
    EXPECT_LE(found[i].newton_iterations, direct.newton_iterations + 3) << times;
  }
}

TEST(Contact, PenaltyFarFromItsDefault) {
  const double usual = default_penalty(on_a_stiff_block(0));
  by_both_solvers(
      "contact penalty, times its default", {1e-3, 1., 10., 1e2, 1e4},
      [&](double times) { return on_a_stiff_block(times * usual); },
      [&](double times) { return on_springs(times * usual); }, 1e-3);
}

// Each node lies on an edge or a corner of the other side, so that its pair may change with round-off.
TEST(Contact, NodesThatMatch) {
  const double usual = default_penalty(two_blocks(3, 3, 0));
  by_both_solvers(
      "contact of matching nodes, penalty times its default", {1., 10., 1e4},
      [&](double times) { return two_blocks(3, 3, times * usual); },
      [&](double times) { return with_penalty(times * usual); }, 1e-5);
}

}  // namespace
}  // namespace bulbus
