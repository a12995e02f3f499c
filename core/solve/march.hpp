#pragma once
#include "core/solve/increments.hpp"
#include "core/solve/newton.hpp"

namespace bulbus::inline solve {

/// In the reason of a march that the memory of the machine did not suffice for.
inline constexpr const char* out_of_memory = "out of memory";

/// One converged increment.
struct Increment {
  int step = 0, number = 0;  ///< number counts over the whole run, from 1
  std::string step_name;
  double progress = 0;  ///< part of the step done
  double time = 0;      ///< steps done + progress
  double seconds = 0;
  NewtonReport newton;
  double next = 0;    ///< part of the step that comes next at a time, if nothing fails
  double start = 0;   ///< part of the step done before
  bool leap = false;  ///< longer than what failed by cycling: states between were not found
};

/// How a march ended, or what it has come to.
struct MarchReport {
  bool converged = false;
  std::string reason;  ///< why not
  std::string remedy;  ///< where a fault of the scene is why
  int signal = 0;      ///< that interrupted it; 0: none did
  int increments = 0, cuts = 0, newton_iterations = 0, krylov_iterations = 0;
};

/// Where a march stands between two increments: by this, the state and the problem's memory it can go on
/// later.
struct MarchProgress {
  int step = 0;
  bool begun = false;
  double done = 0;       ///< part of the step
  Pace pace;             ///< of the next increments
  double last = 0;       ///< the increment that led from `previous` to the present state; 0: no such state
  State previous;        ///< that converged before it in the same step
  bool careful = false;  ///< has an increment of the step failed?
  /// In which the step is expected to end: Newton's method begins there, with all of the step at once.
  std::shared_ptr<const State> expected;
  MarchReport report;
  void next_step();
  /// All but `previous` and `expected`.
  void serialize(Archive& archive);
};

/// Receives what happens; values only.
class MarchObserver {
 public:
  virtual ~MarchObserver() = default;
  virtual void step_begins(int, const StepSpec&, const State&) {}
  /// Its loads, motions and contacts are set up, none of its increments is solved.
  virtual void step_begun(int /*step*/, const State&) {}
  virtual void increment_begins(int /*step*/, double /*from*/, double /*to*/) {}
  virtual void newton_iteration(const NewtonIteration&) {}
  virtual void increment_cut(const NewtonReport&, double /*from*/, double /*to*/) {}
  /// The state has been accepted.
  virtual void increment_done(const Increment&, const State&) {}
  /// All of that is over: here the march may be left and taken up again. `last`: it ends here, finished or
  /// not.
  virtual void rests(const MarchProgress&, State&, bool /*last*/) {}
  /// In place of that, where a signal or a fault of the scene ends the march: the last good state is to be
  /// kept.
  virtual void interrupted(const MarchProgress&, State&) {}
  /// A fault of the scene keeps a step from beginning that others came before: their end is to be kept.
  virtual void step_refused() {}
};

/// Increments of a step that has not begun, if nothing fails.
int increments_of(const StepSpec& step, const SteppingSettings& settings);

/// Runs through all steps from `state`, cutting increments that fail and growing after easy ones. Within a
/// step an increment that follows a converged one begins where the last two states point to. From the first
/// failure in a step on, but for one by first steps that are too long, its linear solves are tight; a small
/// system is tried once more so before the increment is cut. Where even increments of an eighth cycle, longer
/// ones are tried before the march ends: surfaces that snap have no equilibrium near by. On return `state` is
/// the last good one: so it is where an interrupt ends it, or a fault of the scene that shows after the first
/// increment (before, it is thrown as InputError). A `place` in the middle is one to which problem
/// and state have been brought. Collective.
MarchReport march(Problem& problem, LinearSolver& solver, State& state, const SolverSettings& settings,
                  Profiler& profiler, MarchObserver& observer, MarchProgress place = {});

}  // namespace bulbus::inline solve
