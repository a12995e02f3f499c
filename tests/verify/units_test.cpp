// A scene in other units of length and stress is the same scene: same iterations, scaled answer.
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

/// The liquid-filled shell (rigid cap, bars, skew holds) with lengths times `length` and stresses times
/// `stress`.
Scene scaled_shell(double length, double stress) {
  Scene scene = filled_shell("octant");
  for (Point& p : scene.mesh.points)
    for (double& c : p) c *= length;
  Model& m = scene.model;
  for (auto& [name, r] : m.regions)
    for (double* c : {&r.c10, &r.c01, &r.c20}) *c *= stress;
  for (auto& [name, b] : m.bars) b.E *= stress, b.area *= length * length;
  for (auto& [name, l] : m.liquids) l.K *= stress;
  const auto times = [](std::string& text, double factor) {
    text = fmt::format("{:.17g}", std::stod(text) * factor);
  };
  for (StepSpec& s : m.steps) {
    for (auto& [name, pressure] : s.pressures) times(pressure, stress);
    for (DisplaceSpec& d : s.displace) {
      times(*d.radial, length);
      for (double& c : d.center) c *= length;
    }
  }
  m.steps[1].add["fluid"] = 1.5 * length * length * length;
  return scene;
}

void expect_same(Trial& plain, double length, double stress, bool direct) {
  Trial run(scaled_shell(length, stress));
  run.settings.newton = plain.settings.newton;
  direct ? run.direct() : run.iterative();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  std::vector<double> x(run.state.x), lambda(run.state.lambda);
  for (double& v : x) v /= length;
  for (double& v : lambda) v /= stress;
  const double dx = relative_difference(x, plain.state.x),
               dl = relative_difference(lambda, plain.state.lambda),
               dP = relative(run.state.P[0] / stress, plain.state.P[0]);
  measured(
      "scene with lengths x {:g}, stresses x {:g}, {}: {} Newton ({}), {} Krylov iterations ({}); places "
      "{:.1e}, lambda {:.1e}, P {:.1e}",
      length, stress, direct ? "direct" : "iterative", run.report.newton_iterations,
      plain.report.newton_iterations, run.report.krylov_iterations, plain.report.krylov_iterations, dx, dl,
      dP);
  EXPECT_EQ(run.report.increments, plain.report.increments);
  EXPECT_EQ(run.report.newton_iterations, plain.report.newton_iterations);
  EXPECT_EQ(run.report.krylov_iterations, plain.report.krylov_iterations);
  ASSERT_EQ(run.increments.size(), plain.increments.size());
  for (std::size_t i = 0; i < run.increments.size(); ++i) {
    const auto &a = run.increments[i].newton.iterations, &b = plain.increments[i].newton.iterations;
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k)
      EXPECT_EQ(a[k].linear.iterations, b[k].linear.iterations) << i << ' ' << k;
  }
  EXPECT_LT(dx, 1e-8);
  EXPECT_LT(dl, 1e-8);
  EXPECT_LT(dP, 1e-8);
}

TEST(Units, DoNotMatter) {
  for (bool direct : {false, true}) {
    Trial plain(scaled_shell(1, 1));
    plain.settings.newton = {};  // as people run it; the answers agree because the iterates do
    direct ? plain.direct() : plain.iterative();
    ASSERT_TRUE(plain.report.converged) << plain.report.reason;
    for (auto [length, stress] : {std::pair{1e-3, 1.}, {1e3, 1.}, {1e-3, 1e6}, {1e3, 1e-6}, {1., 1e6}})
      expect_same(plain, length, stress, direct);
  }
}

}  // namespace
}  // namespace bulbus
