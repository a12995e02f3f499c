#pragma once
#include <array>
#include <span>

#include "core/base/tensor.hpp"

namespace bulbus::inline eye {

/// Sums over points of a surface that looks along +z, from which fitted_cornea() finds it:
///     |x|² − 2 c·x − k − a (x² − y²) − 2 b x y = 0
/// a sphere about c for a = b = 0, else of different curvature along two meridians. Sums of ranks add up.
struct CornealSums {
  static constexpr int unknowns = 6;
  std::array<double, unknowns*(unknowns + 1)> v{};  ///< normal equations, then their right-hand side
  void add(const Vec3<double>& x);
};

/// Where the z axis meets the surface.
struct CornealVertex {
  double z = 0;                ///< mm
  double steep = 0, flat = 0;  ///< largest and smallest curvature, 1/mm, positive where it is convex
  double meridian = 0;         ///< of the largest, rad from +x towards +y, 0 to π
};

/// Exact on a sphere; on other surfaces curvatures are means over the points. Needs six points at least that
/// do not lie on one circle about the axis.
CornealVertex fitted_cornea(const CornealSums& sums);

}  // namespace bulbus::inline eye
