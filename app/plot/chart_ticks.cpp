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

std::vector<Chart::Tick> log_ticks(double low, double high) {
  std::vector<double> values;
  for (double e = std::floor(std::log10(low)) - 1; e <= std::ceil(std::log10(high)); ++e)
    for (double digit : {1., 2., 5.}) values.push_back(digit * std::pow(10, e));
  const auto first = std::ranges::upper_bound(values, low * (1 + 1e-9)) - 1,
             last = std::ranges::lower_bound(values, high * (1 - 1e-9));
  std::vector<Chart::Tick> ticks;
  for (auto value = first; value <= last && value != values.end(); ++value)
    ticks.push_back({std::log10(*value), fmt::format("{:.6g}", *value)});
  return ticks;
}

std::vector<Chart::Tick> percent_ticks(double low, double high) {
  const double first = std::floor(low + 1e-9), last = std::max(std::ceil(high - 1e-9), first + 1),
               step = std::ceil((last - first) / 5), count = std::ceil((last - first) / step);
  std::vector<Chart::Tick> ticks;
  for (double k = count; k >= 0; --k) {
    const double at = last - k * step, power = at + 2;  // of a per cent
    ticks.push_back(
        {at, power < -2 ? fmt::format("1e{:g} %", power) : fmt::format("{:g} %", std::pow(10, power))});
  }
  return ticks;
}

}  // namespace bulbus::inline app
