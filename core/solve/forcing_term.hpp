#pragma once
#include <algorithm>
#include <utility>

#include "core/solve/fgmres.hpp"

namespace bulbus::inline solve {

/// Relative tolerance of Newton's linear solves: choice 2 of Eisenstat and Walker (Choosing the forcing terms
/// in an inexact Newton method, SIAM J. Sci. Comput. 17, 1996) with its safeguard. Never tighter than a tenth
/// of what is missing, nor than plain GMRES reaches unless the cap is: where motions are prescribed the first
/// right-hand side is theirs, and the ratio of norms promises more than the next tangent keeps. Where the
/// criteria are nearly met, a tenth of what is missing may lie above the cap: tried once, as a region may
/// need more than all together, where prescribed motions are done and no small change is to be followed.
class ForcingTerm {
 public:
  explicit ForcingTerm(double cap) : cap_(cap), eta_(cap) {}
  /// `norm`: of the right-hand side; `excess`: by how much the criteria are missed; `loose`: the cap may be
  /// exceeded.
  double next(double norm, double excess, bool loose) {
    if (before_ > 0) {
      const double ratio = norm / before_, guard = eta_ * eta_;
      eta_ = ratio * ratio;
      if (guard > 0.1) eta_ = std::max(eta_, guard);
    }
    before_ = norm;
    const double enough = 0.1 / excess;
    eta_ = std::min(cap_, std::max({eta_, enough, least_of_plain_method}));
    if (loose && enough > cap_ && !std::exchange(tried_, true)) return enough;
    return std::max(eta_, 1e-13);
  }

 private:
  double cap_, eta_, before_ = 0;
  bool tried_ = false;
};

}  // namespace bulbus::inline solve
