#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/problem/problem.hpp"

namespace bulbus::inline solve {

/// Newton's method goes to and fro between two states where a contact pair that is released comes in again,
/// and is in tension again once it is active. Half a step lands between the two, where the pairs that are
/// right may be found; where it does not help, what the pair holds is not stable without it
/// (docs/decisions/049).
class CycleDetector {
 public:
  /// Part of the next Newton step that may be taken: 1; ½ from the first cycle; 0 once it comes again.
  double longest_step(const EquilibriumError& b) {
    forces_.push_back(b.force);
    if (!cycles()) return 1;
    if (damped_) return 0;
    damped_ = true, forces_.clear();
    return 0.5;
  }

 private:
  static constexpr std::size_t seen = 4;  // returns in a row
  // Relative differences of the equilibrium error: a converging iteration does not come back to a hundredth
  // four times, and one that creeps is nearer to the last state than to the one before it.
  static constexpr double alike = 1e-2, apart = 0.2;
  static constexpr double nearer = 10;

  bool cycles() const {
    const std::size_t n = forces_.size();
    if (n < seen + 2) return false;
    for (std::size_t k = n - seen; k < n; ++k) {
      const double now = forces_[k], between = forces_[k - 1], before = forces_[k - 2];
      const double back = std::abs(now - before), over = std::abs(now - between);
      if (!(back < alike * now) || over < std::max(apart * now, nearer * back)) return false;
    }
    return true;
  }

  std::vector<double> forces_;
  bool damped_ = false;
};

}  // namespace bulbus::inline solve
