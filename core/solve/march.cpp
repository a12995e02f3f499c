#include "core/solve/march.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <new>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/interrupt.hpp"
#include "core/solve/increments.hpp"
#include "core/solve/state_increment.hpp"

namespace bulbus::inline solve {
namespace {

// Errors of loose linear solves are pushes that an exact Newton's method does not feel. Where an increment
// has failed they may have driven it away, as from a symmetric state that is not stable between two
// iterations (docs/decisions/017). A cycle of active sets is one with exact solves, too, and so is an
// increment that is too long for the mesh: where hexahedra would invert, a shorter one comes first.
constexpr double careful_eta = 1e-8;

bool by_loose_solves(const NewtonReport& failed, bool shortened) {
  return failed.outcome != Outcome::linear_solver_failed && failed.outcome != Outcome::cycling &&
         (failed.outcome != Outcome::inverted_element || (shortened && !failed.too_long));
}

// Largest angle by which a set or a rigid body turns within a step, rad.
double largest_turn(const StepSpec& step) {
  double most = 0;
  for (const DisplaceSpec& d : step.displace)
    if (d.rotate) most = std::max(most, std::abs(d.rotate->angle));
  for (const MoveSpec& m : step.move)
    if (m.rotate) most = std::max(most, std::abs(m.rotate->angle));
  return most;
}

// Places before and after a whole turn are the same, and a body's points are followed along straight ways: an
// eighth of a turn leaves 8 % of the radius between arc and chord.
constexpr double turn_of_increment = std::numbers::pi / 4, most_increments = 1e6;

// Part of a step that may be taken at once.
double longest_part(const StepSpec& step) {
  const double turn = largest_turn(step);
  return turn > turn_of_increment ? turn_of_increment / turn : 1;
}

NewtonSettings tolerances_at(double progress, bool careful, NewtonSettings settings) {
  if (careful) settings.eta_max = std::min(settings.eta_max, careful_eta);
  if (progress < 1)
    for (double* tolerance : {&settings.force, &settings.volume, &settings.liquid})
      *tolerance *= settings.intermediate;
  return settings;
}

// Where memory runs out the increment fails, and the state before it is kept. With other ranks waiting for
// this one nothing can be kept.
NewtonReport within_memory(const Comm& comm, const std::function<NewtonReport()>& newton) {
  try {
    return newton();
  } catch (const std::bad_alloc&) {
    if (comm.size() > 1) throw;
    NewtonReport report;
    report.outcome = Outcome::too_large;
    report.reason = std::string(out_of_memory) +
                    ": refine the mesh less, raise the limit of memory (ulimit, control group), or take a "
                    "larger machine";
    return report;
  }
}

// A fault of the scene that shows where there are results already.
void blame(const InputError& fault, const std::string& where, MarchReport& report) {
  const std::string text = fault.what();
  const auto first = text.find("\n  ");  // the remedy has a line of its own
  report.reason = where + ": " + (fault.key.empty() ? "" : fault.key + ": ") + text.substr(0, first);
  report.remedy = first == std::string::npos ? "Change what the scene says there." : text.substr(first + 3);
}

}  // namespace

int increments_of(const StepSpec& step, const SteppingSettings& settings) {
  const double wanted = step.increments * settings.increments,
               turns = std::min(1 / longest_part(step), most_increments);
  return static_cast<int>(std::ceil(std::max(wanted, turns) - 1e-9));
}

void MarchProgress::next_step() {
  begun = careful = false;
  done = last = 0;
  pace = {};
  previous = {};
}

void MarchProgress::serialize(Archive& archive) {
  if (!archive.reading() || archive.knows("careful")) archive.scalars("careful", careful);
  if (!archive.reading() || archive.knows("last")) archive.scalars("last", last);
  if (!archive.reading() || archive.knows("pace"))
    archive.scalars("pace", pace.patience, pace.waited, pace.tried);
  archive.scalars("place", step, begun, done, pace.size, report.increments, report.cuts,
                  report.newton_iterations, report.krylov_iterations);
}

MarchReport march(Problem& problem, LinearSolver& solver, State& state, const SolverSettings& settings,
                  Profiler& profiler, MarchObserver& observer, MarchProgress place) {
  MarchReport& report = place.report;
  double& done = place.done;
  const auto& steps = problem.model().steps;
  // A run that goes on: ways of points begin where it rests, not where the next increment is extrapolated to.
  if (place.begun) problem.residual(state);
  for (int& k = place.step; k < static_cast<int>(steps.size()); ++k, place.next_step()) {
    if (!place.begun) {
      observer.step_begins(k, steps[k], state);
      try {
        problem.begin_step(k, state);
      } catch (const InputError& fault) {
        if (report.increments == 0) throw;
        blame(fault, fmt::format("step '{}' cannot begin", steps[k].name), report);
        observer.step_refused();
        return report;
      }
      solver.forget();
      place.begun = true;
      observer.step_begun(k, state);
    }
    const double longest = longest_part(steps[k]);
    Increments increments(increments_of(steps[k], settings.stepping), settings.stepping, place.pace, longest);
    const auto settle = [&] {
      problem.set_progress(done, state);
      for (const auto& term : problem.terms()) term->roll_back();
    };
    const auto leave = [&] {
      report.signal = interrupt(problem.comm());
      report.reason = describe(Outcome::interrupted);
      settle();
      observer.interrupted(place, state);
      return report;
    };
    bool shortened = false;  // the increment from here on has failed before
    while (done < 1) {
      if (interrupt(problem.comm())) return leave();
      auto expected = std::exchange(place.expected, nullptr);
      if (longest < 1) expected.reset();
      const double to = expected ? 1 : increments.next(done), start = Clock::now();
      observer.increment_begins(k, done, to);
      State trial = expected ? *expected : state;
      NewtonReport newton;
      try {
        if (place.last > 0) extrapolate(problem, place.previous, (to - done) / place.last, trial);
        newton = within_memory(problem.comm(), [&] {
          return bulbus::newton(problem, settings.linear, solver, trial, to,
                                tolerances_at(to, place.careful, settings.newton), profiler,
                                [&](const NewtonIteration& i) { observer.newton_iteration(i); });
        });
      } catch (const InputError& fault) {
        if (report.increments == 0) throw;
        blame(fault, fmt::format("step '{}' stopped at {:.4g} of its way", steps[k].name, done), report);
        settle();
        observer.interrupted(place, state);
        return report;
      }
      report.newton_iterations += static_cast<int>(newton.iterations.size());
      report.krylov_iterations += newton.krylov_iterations;
      if (newton.outcome == Outcome::interrupted) return leave();
      if (newton.outcome != Outcome::converged) {
        for (const auto& term : problem.terms()) term->roll_back();
        solver.forget();
        ++report.cuts;
        place.last = 0;
        observer.increment_cut(newton, done, to);
        // a small system costs nothing
        const bool again = !place.careful && solver.counts_pivots(problem);
        place.careful = place.careful || again || by_loose_solves(newton, shortened);
        shortened = true;
        if (again) continue;
        const bool curable = newton.outcome != Outcome::too_large;  // by smaller increments
        const bool snaps = increments.leaping() || newton.outcome == Outcome::cycling;
        if (curable && snaps && increments.leap(done)) continue;
        if (curable && !increments.leaping() && increments.cut()) continue;
        report.reason =
            fmt::format("step '{}' stopped at {:.4g} of its way: {}{}", steps[k].name, done, newton.reason,
                        !curable               ? ""
                        : increments.leaping() ? " (shorter and longer increments tried)"
                                               : " (smallest increment reached)");
        settle();
        observer.rests(place, state, true);
        return report;
      }
      const bool leap = increments.leaping();
      // across a snap the last two states point nowhere
      place.last = settings.stepping.extrapolate && !leap ? to - done : 0;
      if (place.last > 0) place.previous = std::move(state);
      state = std::move(trial);
      for (const auto& term : problem.terms()) term->commit(state);
      const double from = std::exchange(done, to);
      shortened = false;
      increments.succeeded(static_cast<int>(newton.iterations.size()));
      place.pace = increments.pace();
      const Increment increment{k,
                                ++report.increments,
                                steps[k].name,
                                done,
                                k + done,
                                Clock::now() - start,
                                std::move(newton),
                                place.pace.size,
                                from,
                                leap};
      observer.increment_done(increment, state);
      observer.rests(place, state, done == 1 && k + 1 == static_cast<int>(steps.size()));
    }
    problem.end_step();
  }
  report.converged = true;
  return report;
}

}  // namespace bulbus::inline solve
