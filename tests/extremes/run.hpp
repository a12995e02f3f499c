#pragma once
#include "tests/verify/contact_trial.hpp"

namespace bulbus {

/// The settings that people run with, but for a balance that shows errors of the solver and not of the
/// tolerance.
inline NewtonSettings close_balance() { return {.force = 1e-8, .volume = 1e-8, .liquid = 1e-9}; }

/// Largest number of the state; infinite if one of them is none.
inline double largest(const State& state) {
  return std::max({largest(state.x), largest(state.lambda), largest(state.P)});
}

/// What every run has to end with, finished or not: a state of numbers only, in balance, inverted nowhere; a
/// reason if it stopped.
inline void expect_clean(const Trial& run) {
  EXPECT_TRUE(std::isfinite(largest(run.state)));
  EXPECT_EQ(run.report.converged, run.report.reason.empty());
  EXPECT_GT(run.problem.solid().least_jacobian(run.state.x), 0);
  if (run.report.converged) return;
  EXPECT_NE(run.report.reason.find("stopped at"), std::string::npos) << run.report.reason;
  if (run.increments.empty()) return;
  const EquilibriumError b = run.problem.equilibrium_error(run.problem.residual(run.state));
  const NewtonSettings& asked = run.settings.newton;
  EXPECT_LE(b.force, asked.force);
  EXPECT_LE(b.volume, asked.volume);
  EXPECT_LE(b.liquid, asked.liquid);
}

/// Runs with the default balance, and increments that may be cut down to `smallest` of their step.
inline void as_people_do(Trial& run, double smallest) {
  run.settings.newton = {};
  run.settings.stepping.minimum = smallest;
  run.iterative();
  expect_clean(run);
}

/// One row of docs/extremes.md: extreme | value | what came out | Newton iterations | Krylov iterations |
/// most of one solve | cuts.
template <class... A>
void row(const std::string& extreme, const std::string& value, const Trial& run,
         fmt::format_string<A...> text, A&&... a) {
  const MarchReport& r = run.report;
  const std::string stop = r.converged ? "" : "stops: " + r.reason + "; ";
  measured("{} | {} | {}{} | {} | {} | {} | {}", extreme, value, stop,
           fmt::format(text, std::forward<A>(a)...), r.newton_iterations, r.krylov_iterations,
           most_krylov(run), r.cuts);
}

/// Largest differences of two states.
struct Difference {
  double places;     ///< over the largest displacement
  double pressures;  ///< of hexahedra and liquids, over the largest of each
};

inline Difference difference(const Trial& a, const Trial& b) {
  const std::vector<double> u = plus(b.state.x, -1, b.problem.mesh().X);
  return {largest(plus(a.state.x, -1, b.state.x)) / largest(u),
          worse(relative_difference(a.state.lambda, b.state.lambda),
                b.state.P.empty() ? 0 : relative_difference(a.state.P, b.state.P))};
}

/// The iterative solver and the direct one on the same scene.
struct BothSolvers {
  Trial run, oracle;
  explicit BothSolvers(const Scene& scene, NewtonSettings newton = close_balance(), double smallest = .2)
      : run(scene), oracle(scene) {
    for (Trial* t : {&run, &oracle}) t->settings.newton = newton, t->settings.stepping.minimum = smallest;
    run.iterative(), oracle.direct();
    expect_clean(run), expect_clean(oracle);
  }
  bool both() const { return run.report.converged && oracle.report.converged; }
  Difference apart() const { return difference(run, oracle); }
  /// How far the two are from each other, in words.
  std::string compared() const {
    if (both())
      return fmt::format("from direct: places {:.0e}, pressures {:.0e}", apart().places, apart().pressures);
    return oracle.report.converged
               ? fmt::format("direct finishes in {} iterations", oracle.report.newton_iterations)
               : "direct stops as well: " + oracle.report.reason;
  }
  /// Does each state of the direct solver have the pivots of a stable one?
  bool stable() const {
    const long long pivots = oracle.problem.mesh().all_hexes + static_cast<long long>(oracle.state.P.size());
    return std::ranges::all_of(oracle.increments,
                               [&](const Increment& i) { return i.newton.negative_pivots == pivots; });
  }
};

}  // namespace bulbus
