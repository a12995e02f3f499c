#include "app/records/forecast.hpp"

#include <cmath>

namespace bulbus::inline app {

double Forecast::after(const Increment& increment, std::span<const StepSpec> steps, double seconds) {
  constexpr double weight = 0.3;  // of the newest: increments differ, and steps differ more
  price_ = price_ == 0 ? seconds : (1 - weight) * price_ + weight * seconds;
  double left = std::ceil((1 - increment.progress) / increment.next - 1e-9);
  for (const StepSpec& step : steps.subspan(increment.step + 1)) left += increments_of(step, settings_);
  return left * price_;
}

}  // namespace bulbus::inline app
