#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/mesh/geometry.hpp"
#include "core/problem/spec/rigid_spec.hpp"

namespace bulbus::inline contact {

/// v / |v|; NaN for the zero vector.
inline Vec3<double> unit(const Vec3<double>& v) { return (1 / norm(v)) * v; }

/// Two unit vectors u, v with u × v = n, a unit vector.
inline std::array<Vec3<double>, 2> across(const Vec3<double>& n) {
  const auto shorter = [](double a, double b) { return std::abs(a) < std::abs(b); };
  Vec3<double> a{0, 0, 0};
  a[std::ranges::min_element(n, shorter) - n.begin()] = 1;
  const Vec3<double> u = unit(cross(a, n));
  return {u, cross(n, u)};
}

/// Cylindrical frame of the meridian planes of a scene: x = center + axial · axis + radial · radius(azimuth).
struct MeridianFrame {
  Vec3<double> center, axis, zero, quarter;  ///< quarter: the direction of azimuth 90°

  /// Throws InputError if the axis is zero or along `zero`.
  explicit MeridianFrame(const Meridians& m, const std::string& key) : center(m.center) {
    if (!(norm(cross(m.zero, m.axis)) > 1e-9 * norm(m.zero) * norm(m.axis)))
      throw scene_error(key, "`axis` and `zero` do not span a plane",
                        "Give two directions that are not parallel and not zero.");
    axis = unit(m.axis);
    quarter = unit(cross(m.zero, axis));
    zero = cross(axis, quarter);
  }

  Vec3<double> radius(double azimuth) const {
    const double phi = azimuth * std::numbers::pi / 180;
    return std::cos(phi) * zero + std::sin(phi) * quarter;
  }
  Vec3<double> place(double azimuth, double axial, double radial) const {
    return center + axial * axis + radial * radius(azimuth);
  }
};

}  // namespace bulbus::inline contact
