#include "core/solve/newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/interrupt.hpp"
#include "core/problem/admissible.hpp"
#include "core/problem/enclosed_parts.hpp"
#include "core/solve/cycle_detector.hpp"
#include "core/solve/forcing_term.hpp"
#include "core/solve/small_change.hpp"
#include "core/solve/state_increment.hpp"
#include "core/solve/step_lengths.hpp"

namespace bulbus::inline solve {
namespace {

bool finite(const EquilibriumError& b) {
  return std::isfinite(b.force) && std::isfinite(b.volume) && std::isfinite(b.liquid);
}

// By how much the worst of the three criteria is missed (≤ 1: all hold).
double excess(const EquilibriumError& b, const NewtonSettings& s) {
  return std::max({b.force / s.force, b.volume / s.volume, b.liquid / s.liquid});
}

// What an active set is judged by: looser criteria let sets alternate that are both wrong.
NewtonSettings tightened(NewtonSettings s) {
  const NewtonSettings tight;
  s.force = std::min(s.force, tight.force), s.volume = std::min(s.volume, tight.volume),
  s.liquid = std::min(s.liquid, tight.liquid);
  return s;
}

// Newton's method from one state to equilibrium, iteration by iteration.
class Iteration {
 public:
  Iteration(Problem& problem, const LinearSettings& linear, LinearSolver& solver, State& state,
            const NewtonSettings& settings, Profiler& profiler)
      : problem_(problem),
        linear_(system_settings(linear)),
        solver_(solver),
        state_(state),
        profiler_(profiler),
        forcing_(settings.eta_max),
        solution_(layout_of(problem).size()) {
    double size = 0;
    for (double v : problem.mesh().X) size = std::max(size, std::abs(v));
    negligible_ = 1e-12 * problem.comm().max(size);
  }

  // Residual and prescribed increments of the present state.
  void measure(NewtonIteration& now) {
    compute_residual();
    now.error = problem_.equilibrium_error(*residual_);
    now.prescribed = compute_prescribed();
  }
  bool prescribed_done(const NewtonIteration& now) const { return now.prescribed <= negligible_; }

  // The linearisation before leaves its memory to this one.
  void linearise() {
    const auto scope = profiler_.clock.measure("linearisation");
    solver_.release();
    system_.reset();
    system_ = std::make_shared<const CoupledSystem>(problem_, linear_, state_, *residual_);
  }

  // `excess`: by how much the criteria are missed; `small`: a small change is to be followed.
  LinearReport solve(NewtonIteration& now, double excess, bool small) {
    std::optional<double> tolerance;
    LinearReport report;
    int iterations = 0;
    do {
      const Preparation prepared = solver_.prepare(system_);
      if (!prepared.ok)
        return {.reason = prepared.reason,
                .iterations = iterations,
                .negative_pivots = prepared.negative_pivots,
                .factor = prepared.factor};
      augmentation_ = prepared.augmentation;
      const CoupledOperator A(system_, augmentation_);
      std::vector<double> b = right_hand_side(A);
      if (!tolerance)
        tolerance = std::min(forcing_.next(scaled_norm(*system_, b), excess, prescribed_done(now) && !small),
                             system_->tangents().solve_tolerance());
      now.tolerance = *tolerance;
      report = solver_.solve(A, std::move(b), solution_, *tolerance);
      report.iterations = iterations += report.iterations;
    } while (report.retry);
    measure_memory();
    return report;
  }

  // Moves the state by at most `longest` times the solution, as far as no element inverts. Returns the part
  // of the step taken.
  double step(double longest) {
    const Layout& layout = system_->layout();
    const std::span<const double> solution(solution_);
    StateIncrement step{std::vector<double>(state_.x.size()), layout.primal(solution),
                        layout.lambda(solution),
                        CoupledOperator(system_, augmentation_).pressure_increments(solution)};
    problem_.dofs().expand(state_, step.primal, step.dx);
    compute_prescribed();
    for (std::size_t i = 0; i < prescribed_.size(); ++i) step.dx[i] += prescribed_[i];
    const double length = move_without_inversion(problem_, step, state_, longest);
    for (double& v : step.dx) v *= length;
    problem_.predict(system_->tangents(), step.dx);
    problem_.enclosed().settle(state_.lambda);
    return length;
  }

  // Of the last linearisation; -1 where counting them would be expensive.
  int negative_pivots() { return solver_.counts_pivots(problem_) ? solver_.negative_pivots(*system_) : -1; }

 private:
  void measure_memory() {
    const SolidTangent& solid = system_->solid();
    profiler_.memory.set("solid", solid.solid().bytes() + solid.bytes());
    profiler_.memory.set("operator cache", solid.cache_bytes());
    profiler_.memory.set("coupled system", system_->bytes());
  }
  void compute_residual() {
    const auto scope = profiler_.clock.measure("residual");
    residual_ = problem_.residual(state_);
  }
  // Returns the largest, mm.
  double compute_prescribed() {
    prescribed_.resize(state_.x.size());
    return problem_.dofs().prescribed_increment(state_, problem_.progress(), prescribed_);
  }
  // What it is made of leaves its memory to the solver, and is computed again for a second one.
  std::vector<double> right_hand_side(const CoupledOperator& A) {
    if (!residual_) compute_residual(), compute_prescribed();
    auto b = A.right_hand_side(*residual_, prescribed_);
    residual_.reset();
    std::vector<double>().swap(prescribed_);
    return b;
  }

  Problem& problem_;
  LinearSettings linear_;
  LinearSolver& solver_;
  State& state_;
  Profiler& profiler_;
  ForcingTerm forcing_;
  double negligible_ = 0;  // prescribed increment, mm
  SharedSystem system_;
  std::optional<Residual> residual_;
  LiquidAugmentation augmentation_;
  std::vector<double> prescribed_, solution_;
};

// Why a state in which Newton's method has converged is not to be accepted; empty: it is.
std::string refusal(const Problem& problem, const State& state) {
  std::string why = why_inadmissible(problem, state);
  return why.empty() ? problem.refusal(state) : why;
}

// Counts what the last linear solve has not told.
void judge_stability(Iteration& iteration, NewtonReport& report) {
  if (report.iterations.empty()) return;
  if (report.negative_pivots < 0) report.negative_pivots = iteration.negative_pivots();
  report.negative_curvature =
      report.negative_pivots < 0 && report.iterations.back().linear.curvature < -least_curvature;
}

}  // namespace

std::string describe(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged:
      return "converged";
    case Outcome::inverted_element:
      return "an element would invert";
    case Outcome::linear_solver_failed:
      return "the linear solver failed";
    case Outcome::too_large:
      return "the linear system does not fit into memory";
    case Outcome::too_many_iterations:
      return "too many Newton iterations";
    case Outcome::cycling:
      return "the same two states follow one another";
    case Outcome::not_finite:
      return "the residual is not finite";
    case Outcome::inadmissible:
      return "no body can be in the state that was found";
    case Outcome::interrupted:
      return "interrupted";
  }
  return "";
}

NewtonReport newton(Problem& problem, const LinearSettings& linear, LinearSolver& solver, State& state,
                    double progress, const NewtonSettings& settings, Profiler& profiler,
                    const NewtonObserver& observer) {
  NewtonReport report;
  problem.set_progress(progress, state);
  solver.increment_begins();
  const auto fail = [&](Outcome outcome, std::string reason = {}) {
    report.outcome = outcome;
    report.reason = reason.empty() ? describe(outcome) : std::move(reason);
    return report;
  };
  const auto observe = [&](const NewtonIteration& now) {
    if (observer) observer(now);
  };
  Iteration iteration(problem, linear, solver, state, settings, profiler);
  CycleDetector cycle;
  SmallChange change(progress == 1);
  NewtonSettings criteria = settings;
  int last = settings.max_iterations;
  StepLengths lengths;
  for (int number = 0;; ++number) {
    NewtonIteration now{.number = number};
    iteration.measure(now);
    report.error = now.error;
    if (!finite(now.error)) return fail(Outcome::not_finite);
    change.add(now.error.above_rounding, excess(now.error, criteria));
    if (excess(now.error, criteria) <= 1 && change.followed() && iteration.prescribed_done(now)) {
      if (!problem.update_multipliers(state)) {
        observe(now);
        if (std::string why = refusal(problem, state); !why.empty())
          return fail(Outcome::inadmissible, std::move(why));
        judge_stability(iteration, report);
        return report;
      }
      last = number + settings.max_iterations;
      criteria = tightened(criteria);
      iteration.measure(now);
      report.error = now.error;
    }
    if (number == last) return fail(Outcome::too_many_iterations);
    const double longest = cycle.longest_step(now.error);
    if (longest == 0) return fail(Outcome::cycling);
    if (interrupt(problem.comm())) return fail(Outcome::interrupted);
    iteration.linearise();
    try {
      now.linear = iteration.solve(now, std::max(excess(now.error, criteria), 1.0), change.small());
    } catch (const Interruption&) {
      return fail(Outcome::interrupted);
    }
    report.krylov_iterations += now.linear.iterations;
    report.negative_pivots = now.linear.negative_pivots;
    report.direct_solves += now.linear.by_fallback;
    if (!now.linear.ok) {
      observe(now);
      const bool too_large = now.linear.factor && now.linear.factor->too_large;
      return fail(too_large ? Outcome::too_large : Outcome::linear_solver_failed, now.linear.reason);
    }
    now.step = iteration.step(longest);
    report.iterations.push_back(now);
    observe(now);
    lengths.add(now.step, now.error);
    report.too_long = lengths.too_long();
    if (lengths.exhausted()) return fail(Outcome::inverted_element);
  }
}

}  // namespace bulbus::inline solve
