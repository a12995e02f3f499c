#pragma once
#include <algorithm>

#include "core/solve/settings.hpp"

namespace bulbus::inline solve {

/// How long the next increment is, and when a longer one is tried.
struct Pace {
  double size = 1;     ///< part of the step
  int patience = 2;    ///< increments that have to converge before a longer one is tried that may fail
  int waited = 0;      ///< of these, so many have
  bool tried = false;  ///< is the next one longer than what is known to converge?
};

/// The parts of a step: whole increments as long as nothing fails. A failed one is halved. Increments that
/// take few Newton iterations are followed by longer ones; others by one of twice the length when two in a
/// row have converged, since one may take as many iterations whatever its length, and where that fails again
/// four have to, then eight.
class Increments {
 public:
  /// `count`: whole increments of the step; `longest`: part of it that may be taken at once.
  Increments(int count, const SteppingSettings& settings, const Pace& pace, double longest)
      : settings_(settings), largest_(1.0 / count), longest_(longest), pace_(pace) {
    pace_.size = std::min(pace_.size, largest_);
  }
  const Pace& pace() const { return pace_; }
  /// Where the one that begins at `from` ends.
  double next(double from) const {
    const double to = from + pace_.size;
    return to > 1 - 0.01 * pace_.size ? 1 : to;  // a hundredth of an increment is none of its own
  }
  /// False where they are too short already.
  bool cut() {
    pace_.size /= 2;
    if (pace_.tried) pace_.patience = std::min(2 * pace_.patience, most_patient);
    pace_.waited = 0, pace_.tried = false;
    return pace_.size >= std::min(settings_.minimum, largest_ / most_divided);
  }
  /// Longer ones from where short ones cycle: whole, two whole ones, all the rest. False after the last.
  bool leap(double from) {
    if ((leaps_ == 0 && pace_.size > shortest_cycle * largest_) || leaps_ == 3) return false;
    const double rest = 1 - from;
    ++leaps_;
    pace_.size = std::min(longest_, leaps_ == 3 ? rest : std::min(rest, leaps_ * largest_));
    return true;
  }
  bool leaping() const { return leaps_ > 0; }
  void succeeded(int iterations) {
    leaps_ = 0, pace_.size = std::min(pace_.size, largest_);
    ++pace_.waited, pace_.tried = false;
    if (iterations <= settings_.target_iterations)
      grow(settings_.growth);
    else if (pace_.waited >= pace_.patience)
      pace_.tried = true, grow(2);
  }

 private:
  static constexpr double most_divided = 16;  // four halvings at least, however short whole increments are
  static constexpr double shortest_cycle = 0.125;  // of a whole increment (docs/decisions/049)
  static constexpr int most_patient = 64;

  void grow(double factor) {
    pace_.size = std::min(largest_, pace_.size * factor);
    pace_.waited = 0;
  }

  SteppingSettings settings_;
  double largest_, longest_;
  Pace pace_;
  int leaps_ = 0;
};

}  // namespace bulbus::inline solve
