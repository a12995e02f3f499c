#pragma once
#include "core/solve/newton.hpp"

namespace bulbus {

/// One converged increment.
struct Increment {
  int step = 0, number = 0;  ///< number counts over the whole run, from 1
  std::string step_name;
  double progress = 0;       ///< part of the step done
  double time = 0;           ///< steps done + progress
  double seconds = 0;
  NewtonReport newton;
};

/// Receives what happens; values only.
class MarchObserver {
 public:
  virtual ~MarchObserver() = default;
  virtual void step_begins(int, const StepSpec&) {}
  virtual void increment_begins(int /*step*/, double /*from*/, double /*to*/) {}
  virtual void newton_iteration(const NewtonIteration&) {}
  virtual void increment_cut(const NewtonReport&, double /*from*/, double /*to*/) {}
  /// The state has been accepted.
  virtual void increment_done(const Increment&, const State&) {}
};

/// How a march ended.
struct MarchReport {
  bool converged = false;
  std::string reason;  ///< why not
  int increments = 0, cuts = 0, newton_iterations = 0, krylov_iterations = 0;
};

/// Runs through all steps from `state`, cutting increments that fail and growing after easy ones. On return `state` is the last
/// good one. Collective.
MarchReport march(Problem& problem, CoupledSystem& system, LinearSolver& solver, State& state, const SolverSettings& settings,
                  Meters& meters, MarchObserver& observer);

}  // namespace bulbus
