#pragma once
#include <span>

#include "core/solve/march.hpp"

namespace bulbus::inline app {

/// How long the rest of a march may take: the increments to come, those of the step under way as large as the
/// next one, at the price of the last few.
class Forecast {
 public:
  explicit Forecast(const SteppingSettings& settings = {}) : settings_(settings) {}
  /// After a converged increment that took so many seconds, failed attempts included. Returns seconds; 0 at
  /// the end.
  double after(const Increment& increment, std::span<const StepSpec> steps, double seconds);

 private:
  SteppingSettings settings_;
  double price_ = 0;  // of an increment, s
};

}  // namespace bulbus::inline app
