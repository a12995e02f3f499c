#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/solve/linear_operator.hpp"

namespace bulbus::inline solve {

/// A preconditioner in single precision is linear up to rounding only, and a basis in single precision rounds
/// besides. Below this tolerance what plain GMRES says of its residual is not true any more: such solves take
/// the flexible method, with two bases in double precision.
constexpr double least_of_plain_method = 1e-5;

struct KrylovOptions {
  double tolerance = 1e-6;  ///< on ‖b - A x‖ / ‖b‖
  int restart = 40;         ///< basis vectors; the flexible method holds two vectors for each
  int max_iterations = 400;
  bool flexible = true;               ///< needed unless the preconditioner is_linear(); costs a second basis
  Precision basis = Precision::full;  ///< single: not below least_of_plain_method
  /// Asked after every iteration 1, 2, ... with its residual norm by the method's recurrence; false ends the
  /// method with that iterate and has to come from every rank.
  std::function<bool(int, double)> go_on = {};
};

/// What became of a solve. Norms are Euclidean over all ranks.
struct KrylovReport {
  bool converged = false;
  int iterations = 0;
  double initial = 0, final = 0;  ///< true residual norms ‖b - A x‖
  std::vector<double> history;    ///< residual norm by the method's recurrence after 0, 1, ... iterations
  std::string reason;             ///< why it ended
  std::size_t basis_bytes = 0;  ///< the most that the basis and the method's other vectors held on this rank
};

/// Receives the iteration number (0, 1, ...) and this rank's part of that iterate x. Each call costs one more
/// combination of the whole basis.
using KrylovObserver = std::function<void(int, std::span<const double>)>;

/// Solves A x = b by restarted (flexible) GMRES, preconditioned from the right. Collective.
/// x: initial guess in, solution out. If the method breaks down the report says so and x is the best that is
/// known, which is the initial guess if nothing finite came out. b = 0 gives x = 0 without an iteration.
KrylovReport fgmres(const LinearOperator& A, const Preconditioner* M, std::span<const double> b,
                    std::span<double> x, const KrylovOptions& options, const Comm& comm,
                    const KrylovObserver& observer = {});

}  // namespace bulbus::inline solve
