#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/base/clock.hpp"
#include "core/base/memory.hpp"
#include "core/solve/coupled_system.hpp"
#include "core/solve/fgmres.hpp"
#include "core/solve/mumps.hpp"

namespace bulbus {

/// What became of one linear solve.
struct LinearReport {
  bool ok = false;
  std::string reason;
  bool stale = false;        ///< failed with the preconditioner of an earlier linearisation
  int iterations = 0;        ///< Krylov iterations; 0 of the direct solver
  double reduction = 0;      ///< ‖s r‖ / ‖s b‖ reached
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
  /// After CoupledSystem::linearize. May set the system's liquid augmentation, so right-hand sides come after
  /// it.
  virtual LinearReport prepare(CoupledSystem& system) = 0;
  /// Solution of system · x = b to the relative tolerance in the scaled norm.
  virtual LinearReport solve(const CoupledSystem& system, std::vector<double> b, std::span<double> x,
                             double tolerance) = 0;
  /// The next prepare keeps nothing of earlier linearisations.
  virtual void renew() {}
  /// The next solve is an increment's first: nothing is known of it from those before.
  virtual void increment_begins() {}
  /// Calls `watcher` after every Krylov iteration of every solve.
  virtual void watch(SolveWatcher /*watcher*/) {}
  /// Is it cheap to count the negative pivots of a system whose solution has not told them? Its state has to
  /// be kept for that. Collective.
  virtual bool counts_pivots(const CoupledSystem& /*system*/) { return false; }
  /// -1 if they cannot be counted. Collective.
  virtual int negative_pivots(const CoupledSystem& /*system*/) { return -1; }
};

/// A preconditioner of the whole system.
class CoupledPreconditioner : public Preconditioner {
 public:
  /// Is there a part that is too dear for easy solves?
  virtual bool has_deferred_component() const = 0;
  /// A solve drags or is bound to: takes that part up, until the next linearisation. Collective.
  virtual void enable_deferred_component() = 0;
  /// Extreme eigenvalues of Â⁻¹ A on displacements, estimated by a few Lanczos steps. Collective.
  virtual std::array<double, 2> displacement_spectrum() const = 0;
};

/// What a preconditioner takes from the one made before it: nothing, its coarsest matrix's factors if that
/// matrix has hardly changed, or all that is costly to set up.
enum class SetUp { anew, factors_kept, kept };

struct MadePreconditioner {
  std::unique_ptr<CoupledPreconditioner> preconditioner;
  SetUp how;
};

/// Where `kept` is asked for, what does not fit the system any more is made anew nevertheless.
using PreconditionerFactory = std::function<MadePreconditioner(CoupledSystem&, SetUp)>;

/// GMRES on the scaled system s A s, preconditioned by what the factory makes of every linearisation.
std::unique_ptr<LinearSolver> make_krylov_solver(const LinearSettings& settings,
                                                 PreconditionerFactory factory, Profiler& profiler);

/// MUMPS on the system, augmented by its γ (0 costs nothing and changes no solution). What would not fit into
/// the settings' memory limit is refused by its estimate.
std::unique_ptr<LinearSolver> make_direct_solver(const LinearSettings& settings, Profiler& profiler);

}  // namespace bulbus
