#include "app/study/extrapolation.hpp"

#include <cmath>

namespace bulbus::inline app {
namespace {

constexpr double assumed = 2, least = .5, most = 4;

// (v1 − v2)/(v2 − v3) of values with this order.
double ratio_of(std::span<const double> h, double order) {
  return (std::pow(h[0], order) - std::pow(h[1], order)) / (std::pow(h[1], order) - std::pow(h[2], order));
}

// 0 if there is none between the bounds; the ratio grows with the order.
double order_of(std::span<const double> h, std::span<const double> v) {
  const double ratio = (v[0] - v[1]) / (v[1] - v[2]);
  if (!(ratio >= ratio_of(h, least) && ratio <= ratio_of(h, most))) return 0;
  double low = least, high = most;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (ratio_of(h, middle) < ratio ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

Extrapolated extrapolate(std::span<const double> h, std::span<const double> v) {
  Extrapolated e{.order = h.size() > 2 ? order_of(h.last(3), v.last(3)) : 0};
  e.observed = e.order > 0;
  if (!e.observed) e.order = assumed;
  const std::size_t fine = v.size() - 1;
  e.value = v[fine] + (v[fine] - v[fine - 1]) / (std::pow(h[fine - 1] / h[fine], e.order) - 1);
  return e;
}

}  // namespace bulbus::inline app
