#pragma once
#include "contact/surfaces/pair.hpp"

namespace bulbus::inline contact {

/// Nearest point of a triangle, by its barycentric weights: a corner has one that is not 0, an edge two.
struct NearestPoint {
  std::array<double, 3> weights;
  double distance;  ///< mm
};
/// Ericson, Real-Time Collision Detection (2005), 5.1.5.
NearestPoint nearest_point(const Vec3<double>& x, const Triangle& corners);

}  // namespace bulbus::inline contact
