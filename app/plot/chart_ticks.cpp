#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/plot/chart.hpp"

namespace bulbus::inline app {
namespace {

// 1, 2 or 5 times a power of ten, for about five steps.
double round_step(double span) {
  const double rough = span / 5, power = std::pow(10, std::floor(std::log10(rough)));
  for (double m : {1.0, 2.0, 5.0})
    if (rough <= m * power) return m * power;
  return 10 * power;
}

std::string tick_text(double value, double step) {
  if (std::abs(value) >= 1e6 || step < 1e-5) return fmt::format("{:.6g}", value);
  return fmt::format("{:.{}f}", value, std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9))));
}

}  // namespace

std::vector<Chart::Tick> round_ticks(double low, double high) {
  // what differs by less than one part in 10,000 is drawn level
  const double least = std::max(1e-4 * std::max(std::abs(low), std::abs(high)), 1e-12);
  if (high - low < least) {
    const double middle = (low + high) / 2;
    low = middle - least, high = middle + least;
  }
  const double step = round_step(high - low);
  std::vector<Chart::Tick> ticks;
  const auto first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  // + 0. makes -0 a 0
  for (double k = first; k <= last; ++k) ticks.push_back({k * step + 0., tick_text(k * step + 0., step)});
  return ticks;
}

}  // namespace bulbus::inline app
