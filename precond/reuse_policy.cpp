#include "precond/reuse_policy.hpp"

#include <algorithm>

namespace bulbus::inline precond {
namespace {

// A Chebyshev polynomial amplifies what lies above its interval, and that has a reserve of a tenth: from a
// growth by 30 % on, as of a new contact, solves took hundreds of iterations (docs/decisions/012).
constexpr double growth_of_largest_eigenvalue = 1.3;

// After a solve of more iterations per digit than that, a set-up is cheap beside the next one, and near limit
// points, where the matrix changes its sign, it is needed (docs/decisions/013).
constexpr double slow_per_digit = 4;

// Times the iterations per digit of the solve for which the coarse factors were made; for the same reason.
constexpr double much_slower = 2;

}  // namespace

Reuse reusable(const ReuseLimits& limits, const SolveHistory& history, const TangentChange& change) {
  if (history.solves == 0) return {};
  const bool as_fast = history.last <= limits.slowdown * history.first;
  if (as_fast && change.largest_eigenvalue < growth_of_largest_eigenvalue)
    return {.displacement = true, .coarse_factors = true, .corrections = true};
  const bool easy = as_fast || history.last <= std::min(much_slower * history.first, slow_per_digit);
  if (!easy || limits.coarse_change == 0 || !(change.coarse_rows <= limits.coarse_change)) return {};
  return {.coarse_factors = true, .corrections = limits.corrections_own_lines};
}

}  // namespace bulbus::inline precond
