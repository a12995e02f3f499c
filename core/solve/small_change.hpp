#pragma once
#include <algorithm>
#include <vector>

namespace bulbus::inline solve {

/// A change that the criteria hardly see or not at all, as that of a small load beside large ones: criteria
/// are relative to all forces of a region, figures `since` a step to the change alone. Where the excess stays
/// below 1/part in a step's last increment, what is missing has to fall to `part` of the most that was, in
/// every region, body and liquid, as far as rounding lets it.
class SmallChange {
 public:
  static constexpr double part = 1e-3;
  /// `last`: the increment ends its step.
  explicit SmallChange(bool last) : small_(last) {}

  /// The next iterate; `missing` as EquilibriumError::above_rounding, `excess`: by how much the criteria are
  /// missed.
  void add(const std::vector<double>& missing, double excess) {
    if (excess >= 1 / part) small_ = false;
    most_.resize(missing.size());
    const bool first = iterates_++ == 0;
    followed_ = true;
    for (std::size_t k = 0; k < missing.size(); ++k) {
      most_[k] = std::max(most_[k], missing[k]);
      followed_ &= missing[k] <= std::max(1.0, first ? 0 : part * most_[k]);
    }
  }
  bool small() const { return small_; }
  /// May Newton's method end, if the criteria hold? Each iteration gains two or three digits: what four leave
  /// is rounding.
  bool followed() const { return !small_ || followed_ || iterates_ > 4; }

 private:
  bool small_, followed_ = false;
  int iterates_ = 0;
  std::vector<double> most_;
};

}  // namespace bulbus::inline solve
