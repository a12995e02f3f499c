#include "core/solve/newton.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/interrupt.hpp"
#include "core/problem/admissible.hpp"
#include "core/problem/enclosed_parts.hpp"

namespace bulbus {
namespace {

constexpr double least_curvature = 1e-2;  // relative; beneath, a linear solve's tolerance may have made it
constexpr double shortest_step = 1.0 / 64;
// Of all Newton steps together, where each would have inverted an element: the increment is too long for the
// mesh, and two of half the length cost less than what is to come.
constexpr double least_length = 1.0 / 8;
constexpr double least_volume =
    0.05;  // J of a Gauss point relative to where the step starts from: a guard, not a model

double scaled_norm(const CoupledSystem& system, std::span<const double> v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += std::pow(system.scaling()[i] * v[i], 2);
  return std::sqrt(system.problem().comm().sum(sum));
}

bool finite(const Balance& b) {
  return std::isfinite(b.force) && std::isfinite(b.volume) && std::isfinite(b.liquid);
}

// By how much the worst of the three criteria is missed (≤ 1: all hold).
double excess(const Balance& b, const NewtonSettings& s) {
  return std::max({b.force / s.force, b.volume / s.volume, b.liquid / s.liquid});
}

// What an active set is judged by: looser criteria let sets alternate that are both wrong.
NewtonSettings tightened(NewtonSettings s) {
  const NewtonSettings tight;
  s.force = std::min(s.force, tight.force), s.volume = std::min(s.volume, tight.volume),
  s.liquid = std::min(s.liquid, tight.liquid);
  return s;
}

// Eisenstat-Walker choice 2 with its safeguard; never tighter than a tenth of what is missing, nor than plain
// GMRES reaches unless the cap is: where motions are prescribed the first right-hand side is theirs, and the
// ratio of norms promises more than the next tangent keeps. Where the criteria are nearly met, a tenth of
// what is missing may lie above the cap: tried once, as a region may need more than all together, and where
// prescribed motions are done.
class ForcingTerm {
 public:
  explicit ForcingTerm(double cap) : cap_(cap), eta_(cap) {}
  double next(double norm, double excess, bool held) {
    if (before_ > 0) {
      const double ratio = norm / before_, guard = eta_ * eta_;
      eta_ = ratio * ratio;
      if (guard > 0.1) eta_ = std::max(eta_, guard);
    }
    before_ = norm;
    const double enough = 0.1 / excess;
    eta_ = std::min(cap_, std::max({eta_, enough, least_of_plain_method}));
    if (held && enough > cap_ && !std::exchange(tried_, true)) return enough;
    return std::max(eta_, 1e-13);
  }

 private:
  double cap_, eta_, before_ = 0;
  bool tried_ = false;
};

// Newton's method goes to and fro between two states where a contact pair that is released comes in again,
// and is in tension again once it is active: what it holds is not stable without it.
class CycleDetector {
 public:
  bool found(const Balance& b) {
    forces_.push_back(b.force);
    const std::size_t n = forces_.size();
    if (n < seen + 2) return false;
    for (std::size_t k = n - seen; k < n; ++k) {
      const double now = forces_[k], between = forces_[k - 1], before = forces_[k - 2];
      if (!(std::abs(now - before) < alike * now) || std::abs(now - between) < apart * now) return false;
    }
    return true;
  }

 private:
  static constexpr std::size_t seen = 4;  // returns in a row
  static constexpr double alike = 1e-2, apart = 0.5;
  std::vector<double> forces_;
};

struct Step {
  std::vector<double> dx;  // local nodes
  std::span<const double> primal, dlambda;
  std::vector<double> dP;
};

void take(const Problem& problem, const Step& step, double length, State& state) {
  problem.dofs().move(state, step.dx, step.primal, length);
  for (std::size_t e = 0; e < state.lambda.size(); ++e) state.lambda[e] += length * step.dlambda[e];
  for (std::size_t i = 0; i < state.P.size(); ++i) state.P[i] += length * step.dP[i];
}

// The longest of 1, ½, ¼, ... that inverts nothing; 0 if none does. `state` is moved.
double guarded(const Problem& problem, const Step& step, State& state) {
  const double before = std::min(1.0, problem.comm().min(problem.solid().least_jacobian(state.x)));
  for (double length = 1; length >= shortest_step; length /= 2) {
    State trial = state;
    take(problem, step, length, trial);
    if (problem.comm().min(problem.solid().least_jacobian(trial.x)) > least_volume * before) {
      state = std::move(trial);
      return length;
    }
  }
  return 0;
}

// One linear solve to the tolerance that `tolerance` gives for the right-hand side that `make` makes. Where
// the preconditioner of an earlier linearisation fails, it is done once more with a new one.
template <class Make, class Tolerance>
LinearReport solve(CoupledSystem& system, LinearSolver& solver, Make make, std::span<double> solution,
                   Tolerance tolerance, int spent = 0) {
  LinearReport report = solver.prepare(system);
  if (!report.ok) return report;
  std::vector<double> b = make();
  const double enough = tolerance(b);
  report = solver.solve(system, std::move(b), solution, enough);
  report.iterations += spent;
  if (!report.stale) return report;
  solver.renew();
  return solve(system, solver, make, solution, tolerance, report.iterations);
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

NewtonReport newton(Problem& problem, CoupledSystem& system, LinearSolver& solver, State& state,
                    double progress, const NewtonSettings& settings, Profiler& profiler,
                    const NewtonObserver& observer) {
  NewtonReport report;
  ForcingTerm forcing(settings.eta_max);
  problem.set_progress(progress, state);
  solver.increment_begins();
  const auto fail = [&](Outcome outcome, std::string reason = {}) {
    report.outcome = outcome;
    report.reason = reason.empty() ? describe(outcome) : std::move(reason);
    return report;
  };
  std::vector<double> held, solution(system.size());
  double size = 0;
  for (double v : problem.mesh().X) size = std::max(size, std::abs(v));
  const double held_tolerance = 1e-12 * problem.comm().max(size);
  std::optional<Residual> r;
  std::optional<State> linearised;
  const auto find_residual = [&] {
    const auto scope = profiler.clock.measure("residual");
    r = problem.residual(state);
  };
  const auto balance = [&] {
    find_residual();
    return report.balance = problem.balance(*r);
  };
  const auto find_held = [&] {
    held.resize(state.x.size());
    return problem.dofs().defect(state, progress, held);
  };
  // residual and held increments make room for the solver
  const auto right_hand_side = [&] {
    if (!r) find_residual(), find_held();
    auto b = system.right_hand_side(*r, held);
    r.reset();
    std::vector<double>().swap(held);
    return b;
  };
  const auto judge_stability = [&] {
    if (report.iterations.empty()) return;
    if (report.negative_pivots < 0 && linearised) report.negative_pivots = solver.negative_pivots(system);
    report.negative_curvature =
        report.negative_pivots < 0 && report.iterations.back().linear.curvature < -least_curvature;
  };
  int last = settings.max_iterations;
  double length = 1;
  CycleDetector cycle;
  NewtonSettings criteria = settings;
  for (int number = 0;; ++number) {
    NewtonIteration now{.number = number};
    now.balance = balance();
    now.held = find_held();
    if (!finite(now.balance)) return fail(Outcome::not_finite);
    double missing = excess(now.balance, criteria);
    if (missing <= 1 && now.held <= held_tolerance) {
      if (!problem.revise(state)) {
        if (observer) observer(now);
        if (std::string why = why_inadmissible(problem, state); !why.empty())
          return fail(Outcome::inadmissible, std::move(why));
        if (std::string why = problem.refusal(state); !why.empty())
          return fail(Outcome::inadmissible, std::move(why));
        judge_stability();
        return report;
      }
      last = number + settings.max_iterations;
      criteria = tightened(criteria);
      now.balance = balance();
      missing = excess(now.balance, criteria);
    }
    if (number == last) return fail(Outcome::too_many_iterations);
    if (cycle.found(now.balance)) return fail(Outcome::cycling);
    if (interrupt(problem.comm())) return fail(Outcome::interrupted);
    {
      const auto scope = profiler.clock.measure("linearisation");
      if (solver.counts_pivots(system)) linearised = state;
      system.linearize(linearised ? *linearised : state, *r);
    }
    try {
      now.linear = solve(system, solver, right_hand_side, solution, [&](std::span<const double> b) {
        if (now.tolerance == 0) {
          now.tolerance =
              forcing.next(scaled_norm(system, b), std::max(missing, 1.0), now.held <= held_tolerance);
          now.tolerance = std::min(now.tolerance, problem.solve_tolerance());
        }
        return now.tolerance;
      });
    } catch (const Interruption&) {
      return fail(Outcome::interrupted);
    }
    report.krylov_iterations += now.linear.iterations;
    report.negative_pivots = now.linear.negative_pivots;
    report.direct_solves += now.linear.by_fallback;
    if (!now.linear.ok) {
      if (observer) observer(now);
      const bool too_large = now.linear.factor && now.linear.factor->too_large;
      return fail(too_large ? Outcome::too_large : Outcome::linear_solver_failed, now.linear.reason);
    }
    const Layout& layout = system.layout();
    Step step{std::vector<double>(state.x.size()), layout.primal(std::span<const double>(solution)),
              layout.lambda(std::span<const double>(solution)), system.pressure_increments(solution)};
    problem.dofs().expand(state, step.primal, step.dx);
    find_held();
    for (std::size_t i = 0; i < held.size(); ++i) step.dx[i] += held[i];
    now.step = guarded(problem, step, state);
    for (double& v : step.dx) v *= now.step;
    problem.predict(step.dx);
    problem.enclosed().settle(state.lambda);
    report.iterations.push_back(now);
    if (observer) observer(now);
    length *= now.step;
    if (length <= least_length) return fail(Outcome::inverted_element);
  }
}

}  // namespace bulbus
