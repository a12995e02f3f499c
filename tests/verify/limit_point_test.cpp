// A thin neo-Hookean sphere through its pressure maximum. Only the coupled system passes: at the maximum the
// tangent at fixed pressure is singular, and beyond it indefinite.
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

constexpr double inner_radius = 10, outer_radius = 10.2, c10 = .0833;

/// Pressure at the stretch of the inside.
double closed_form(double la) {
  const double lb = std::cbrt(1 + (la * la * la - 1) * std::pow(inner_radius / outer_radius, 3));
  return c10 * (4 / lb + 1 / std::pow(lb, 4) - 4 / la - 1 / std::pow(la, 4));
}

struct Maximum {
  double stretch, pressure;
};

Maximum closed_form_maximum() {
  double low = 1.1, high = 1.8;
  for (int i = 0; i < 200; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (closed_form(a) < closed_form(b) ? low : high) = closed_form(a) < closed_form(b) ? a : b;
  }
  return {low, closed_form(low)};
}

Scene balloon(int n) {
  Scene scene{generate(ShellShape{.inner = inner_radius, .outer = outer_radius, .n = n, .layers = 1}), {}};
  Model& m = scene.model;
  m.regions["shell"] = neo_hooke(c10);
  m.liquids["fluid"] = {.surface = "inner"};
  m.symmetry = {"x", "y", "z"};
  return scene;
}

double volume(const Problem& problem, const State& state) { return problem.liquids()[0].volume(state.x); }

/// Worst deviation from the closed form on the way, relative to the largest pressure.
double inflate(int n) {
  Scene scene = balloon(n);
  StepSpec s = step("inflate", 20);
  s.enclose = {"fluid"};
  scene.model.steps.push_back(s);
  const Problem still(scene.mesh, scene.model, Comm(MPI_COMM_SELF));
  const double V0 = volume(still, still.initial_state());
  scene.model.steps[0].add["fluid"] = 8 * 6 * V0;  // to a stretch of 7^(1/3) = 1.91
  Trial run(scene);
  run.settings.newton = tight(1e-9, 1e-11);
  const Maximum top = closed_form_maximum();
  double worst = 0, highest = 0;
  int before = 0, after = 0;
  run.watch = [&](const Increment&, const State& state) {
    const double stretch = std::cbrt(volume(run.problem, state) / V0), p = state.P[0];
    worst = worse(worst, std::abs(p - closed_form(stretch)) / top.pressure);
    highest = std::max(highest, p);
    stretch < top.stretch ? ++before : ++after;
  };
  run.iterative();
  EXPECT_TRUE(run.report.converged) << run.report.reason;
  EXPECT_EQ(run.report.cuts, 0);
  EXPECT_GE(before, 3);
  EXPECT_GE(after, 8);
  EXPECT_LT(run.state.P[0], .85 * highest);
  measured(
      "thin sphere, {} hexahedra: largest pressure {:.6f} (closed form {:.6f} at stretch {:.4f}), last "
      "{:.6f} (closed form {:.6f}); worst {:.3f} % of the maximum; {} Newton, {} Krylov iterations",
      run.problem.mesh().all_hexes, highest, top.pressure, top.stretch, run.state.P[0],
      closed_form(std::cbrt(volume(run.problem, run.state) / V0)), 100 * worst, run.report.newton_iterations,
      run.report.krylov_iterations);
  return worst;
}

TEST(LimitPoint, LiquidCarriesASphereOverItsLargestPressure) {
  const double coarse = inflate(4), fine = inflate(8);
  EXPECT_LT(fine, .005);
  EXPECT_NEAR(std::log2(coarse / fine), 2, .2);
}

TEST(LimitPoint, PressureControlEndsBelowItWithAReason) {
  Scene scene = balloon(4);
  StepSpec s = step("blow", 7);
  const Maximum top = closed_form_maximum();
  s.pressures["fluid"] = fmt::format("{:.17g}", 1.2 * top.pressure);
  scene.model.steps.push_back(s);
  Trial run(scene);
  run.settings.newton = tight(1e-8);
  run.settings.stepping.minimum = 1e-2;
  run.iterative();
  EXPECT_FALSE(run.report.converged);
  EXPECT_NE(run.report.reason.find("step 'blow' stopped at 0."), std::string::npos) << run.report.reason;
  ASSERT_FALSE(run.increments.empty());
  EXPECT_NEAR(run.problem.progress(), run.increments.back().progress, 1e-14);
  EXPECT_GT(run.state.P[0], .9 * top.pressure);
  EXPECT_LT(run.state.P[0], 1.02 * top.pressure);
  const EquilibriumError b = run.problem.equilibrium_error(run.problem.residual(run.state));
  EXPECT_LT(b.force, 1e-8);
  EXPECT_LT(b.volume, 1e-8);
  measured("thin sphere under pressure alone: stopped at {:.4f} of the largest pressure; {}",
           run.state.P[0] / top.pressure, run.report.reason);
}

}  // namespace
}  // namespace bulbus
