#pragma once
#include <span>

namespace bulbus::inline app {

/// A figure as cells of size 0 would give it, v(h) = value + c h^order.
struct Extrapolated {
  double value = 0, order = 0;
  bool observed = false;  ///< the order, from three sizes; else it is assumed to be 2
};

/// Richardson's extrapolation from values at two or three sizes h, by falling h. Where three show no order
/// between ½ and 4, as values that go up and down do, the two finest are taken with the order assumed.
Extrapolated extrapolate(std::span<const double> h, std::span<const double> v);

}  // namespace bulbus::inline app
