#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/clock.hpp"
#include "core/base/memory.hpp"
#include "core/solve/coupled_operator.hpp"
#include "core/solve/factorisation.hpp"
#include "core/solve/fgmres.hpp"

namespace bulbus::inline solve {

/// What became of one linear solve.
struct LinearReport {
  bool ok = false;
  std::string reason;
  bool retry = false;    ///< failed, but may succeed with what the next prepare() makes of the same system
  int iterations = 0;    ///< Krylov iterations; 0 of the direct solver
  double reduction = 0;  ///< ‖s r‖ / ‖s b‖ reached
  bool by_fallback = false;  ///< MUMPS solved it in place of GMRES, which did not
  int negative_pivots = -1;  ///< of the direct solver's factors
  /// x·Kx of the displacements found, over the sum of the magnitudes it is made of; 0 where GMRES did not
  /// find them. Negative only in a state that is not stable, as far as x changes no volume.
  double curvature = 0;
  std::optional<FactorReport> factor;  ///< of the direct solver
  std::vector<double>
      history;  ///< scaled residual norm by the method's recurrence after 0, 1, ... iterations
  /// On request: true scaled residual norms of displacements, element pressures and liquids, iteration by
  /// iteration.
  std::vector<std::array<double, 3>> blocks;
  /// On request: extreme eigenvalues of the preconditioned displacement block, as Lanczos estimates them.
  std::array<double, 2> spectrum{};
};

/// What a solver has made of a linearisation.
struct Preparation {
  bool ok = false;
  std::string reason;                  ///< why not ok
  LiquidAugmentation augmentation;     ///< of the operator that solve() is to be given
  std::optional<FactorReport> factor;  ///< of the direct solver
  int negative_pivots = -1;            ///< of its factors
};

/// How far a linear solve has come.
struct SolveProgress {
  int iteration = 0;
  double residual = 0;   ///< relative to the right-hand side, scaled
  double tolerance = 0;  ///< to be reached
};
using SolveWatcher = std::function<void(const SolveProgress&)>;

/// Where a run keeps count of its seconds and bytes.
struct Profiler {
  Clock clock;
  MemoryTally memory;
};

/// Solves the coupled system of one linearisation: first prepare, then any number of right-hand sides.
/// Collective.
class LinearSolver {
 public:
  virtual ~LinearSolver() = default;
  virtual Preparation prepare(SharedSystem system) = 0;
  /// Solution of A x = b to the relative tolerance in the scaled norm; A: of the system and the augmentation
  /// of the last prepare().
  virtual LinearReport solve(const CoupledOperator& A, std::vector<double> b, std::span<double> x,
                             double tolerance) = 0;
  /// Gives up the linearisation that it was prepared for, whose memory the next one needs, but nothing that
  /// the next prepare() may take over.
  virtual void release() {}
  /// The next prepare() takes nothing over from earlier linearisations.
  virtual void forget() {}
  /// The next solve is an increment's first: nothing is known of it from those before.
  virtual void increment_begins() {}
  /// Calls `watcher` after every Krylov iteration of every solve.
  virtual void watch(SolveWatcher /*watcher*/) {}
  /// Is it cheap to count the negative pivots of a problem's systems whose solution has not told them?
  /// Collective.
  virtual bool counts_pivots(const Problem& /*problem*/) { return false; }
  /// -1 if they cannot be counted. Collective.
  virtual int negative_pivots(const CoupledSystem& /*system*/) { return -1; }
};

/// A preconditioner of the whole system.
class CoupledPreconditioner : public Preconditioner {
 public:
  /// Of the operator that it is made for.
  virtual const LiquidAugmentation& augmentation() const = 0;
  /// Is there a part that is too expensive for easy solves?
  virtual bool has_deferred_component() const = 0;
  /// A solve, to this relative tolerance, is slow or is bound to be: takes that part up, until the next
  /// linearisation. Collective.
  virtual void enable_deferred_component(double tolerance) = 0;
  /// Extreme eigenvalues of Â⁻¹ A on displacements, estimated by a few Lanczos steps. Collective.
  virtual std::array<double, 2> displacement_spectrum() const = 0;
  /// Of one that is made of factors of the whole system.
  virtual std::optional<FactorReport> factor() const { return {}; }
};

/// Makes preconditioners of one linearisation after the other, and decides by their solves what the next one
/// takes over.
class PreconditionerFactory {
 public:
  virtual ~PreconditionerFactory() = default;
  /// The one before it should be gone: two would need the memory of both. Collective.
  virtual std::unique_ptr<CoupledPreconditioner> make(SharedSystem system) = 0;
  /// What is kept for later gives up the linearisation that it was made for.
  virtual void release() = 0;
  /// A solve took so many Krylov iterations per digit; the same on every rank.
  virtual void record(double iterations_per_digit) = 0;
  /// May another preconditioner of the same linearisation do better: one that takes nothing over, or one that
  /// factorises what this one approximates?
  virtual bool can_improve() const = 0;
  /// After a solve that failed: the next one is that.
  virtual void improve() = 0;
  /// The next one takes nothing over.
  virtual void forget() = 0;
};

/// GMRES on the scaled system s A s, preconditioned by what the factory makes of every linearisation.
std::unique_ptr<LinearSolver> make_krylov_solver(const LinearSettings& settings,
                                                 std::unique_ptr<PreconditionerFactory> factory,
                                                 Profiler& profiler);

/// The settings' direct solver on the system, augmented by its γ (0 costs nothing and changes no solution).
/// What would not fit into the settings' memory limit is refused by its estimate.
std::unique_ptr<LinearSolver> make_direct_solver(const LinearSettings& settings, Profiler& profiler);

}  // namespace bulbus::inline solve
