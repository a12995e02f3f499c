#pragma once
#include <cmath>
#include <vector>

#include "core/problem/problem.hpp"

namespace bulbus::inline solve {

/// Newton's method goes to and fro between two states where a contact pair that is released comes in again,
/// and is in tension again once it is active: what it holds is not stable without it.
class CycleDetector {
 public:
  bool found(const EquilibriumError& b) {
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
  static constexpr std::size_t seen = 4;  // returns in a row (docs/decisions/049)
  // Relative differences of the equilibrium error: a converging iteration does not come back to a hundredth
  // four times, and one that creeps does not go to and fro by half.
  static constexpr double alike = 1e-2, apart = 0.5;
  std::vector<double> forces_;
};

}  // namespace bulbus::inline solve
