#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/problem/problem.hpp"

namespace bulbus::inline solve {

/// Newton's method goes to and fro between two states where a contact pair that is released comes in again,
/// and is in tension again once it is active. Half a step lands between the two, where the pairs that are
/// right may be found, or the error is less; where it does not help, what the pair holds is not stable
/// without it (docs/decisions/049).
class CycleDetector {
 public:
  /// Part of the next Newton step that may be taken: 1; ½ from a cycle; 0 from one whose error is more than
  /// half of that of the cycle before.
  double longest_step(const EquilibriumError& b) {
    forces_.push_back(b.force);
    if (!cycles()) return 1;
    const double least = std::min(forces_.back(), forces_[forces_.size() - 2]);
    if (level_ > 0 && least > 0.5 * level_) return 0;
    level_ = least, forces_.clear();
    return 0.5;
  }

 private:
  static constexpr std::size_t seen = 4, seen_again = 2;  // returns in a row
  // Relative differences of the equilibrium error: a converging iteration does not come back to a hundredth
  // four times, and one that creeps is nearer to the last state than to the one before it.
  static constexpr double alike = 1e-2, apart = 0.02;
  static constexpr double nearer = 10;

  bool cycles() const {
    const std::size_t n = forces_.size(), returns = level_ > 0 ? seen_again : seen;
    if (n < returns + 2) return false;
    for (std::size_t k = n - returns; k < n; ++k) {
      const double now = forces_[k], between = forces_[k - 1], before = forces_[k - 2];
      const double back = std::abs(now - before), over = std::abs(now - between);
      if (!(back < alike * now) || over < std::max(apart * now, nearer * back)) return false;
    }
    return true;
  }

  std::vector<double> forces_;
  double level_ = 0;  // the lesser error of the last cycle; 0: none yet
};

}  // namespace bulbus::inline solve
