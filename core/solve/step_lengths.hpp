#pragma once
#include "core/problem/problem.hpp"

namespace bulbus::inline solve {

/// The parts of Newton steps that the guard against inversion leaves. An increment is too long for the mesh,
/// and two of half its length cost less than what is to come, where no more than an eighth is left of the
/// first four steps together, or of one from a state in which a hexahedron has more than twice its volume. A
/// few short steps from other states are allowed (docs/decisions/033).
class StepLengths {
 public:
  /// `before`: the error of the state that the step begins at.
  void add(double part, const EquilibriumError& before) {
    shortened_ += part < 1;
    nothing_left_ = part == 0;
    if (++steps_ <= first) of_first_ *= part;
    too_long_ = of_first_ <= least || (part <= least && before.volume > most_volume);
  }
  bool too_long() const { return too_long_; }
  /// The increment is to be given up.
  bool exhausted() const { return nothing_left_ || shortened_ == most_shortened || too_long_; }

 private:
  static constexpr int first = 4, most_shortened = 8;
  static constexpr double least = 1.0 / 8, most_volume = 1;
  int steps_ = 0, shortened_ = 0;
  double of_first_ = 1;
  bool nothing_left_ = false, too_long_ = false;
};

}  // namespace bulbus::inline solve
