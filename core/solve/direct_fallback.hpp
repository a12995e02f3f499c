#pragma once
#include <optional>

#include "core/solve/linear_solver.hpp"
#include "core/solve/mumps.hpp"

namespace bulbus::inline solve {

/// MUMPS on single systems that the iterative solver gave up on. Factors are released as soon as they have
/// done their work. All members are collective.
class DirectFallback {
 public:
  DirectFallback(const LinearSettings& settings, Profiler& profiler);

  /// Is it allowed, and will it fit into memory beside what is resident now?
  bool available(const Problem& problem);
  /// Solution of A x = b, refined to the tolerance in the scaled norm where rounding lets it. Not ok
  /// where MUMPS fails or refuses by its own estimate; it is not available any more then, if it was for want
  /// of memory.
  LinearReport solve(const CoupledOperator& A, std::span<const double> b, std::span<double> x,
                     double tolerance);
  /// Negative eigenvalues of a symmetric system, from its factors; -1 if they cannot be made.
  int negative_pivots(const CoupledSystem& system);
  /// Is factorising so cheap that it is not worth while to try anything else?
  bool cheap(const Problem& problem) const;

 private:
  FactorReport factorise(const CoupledSystem& system, Mumps& mumps);
  double available_mb(const Comm& comm) const;

  bool allowed_;
  double limit_mb_;
  Profiler& profiler_;
  std::optional<bool> fits_;
};

}  // namespace bulbus::inline solve
