#pragma once
#include <array>

#include "core/base/tensor.hpp"

namespace bulbus::inline contact {

using Triangle = std::array<Vec3<double>, 3>;

inline Vec3<double> centroid(const Triangle& v) {
  Vec3<double> middle;
  for (int c = 0; c < 3; ++c) middle[c] = (v[0][c] + v[1][c] + v[2][c]) / 3;
  return middle;
}

/// Inner angle at corner `i`, rad.
double angle_at(const Triangle& v, int i);

/// A slave node x above or below a master triangle x1 x2 x3 and its perpendicular projection in the
/// triangle's plane (formulation, section 5):
///     n = e1×e2/j,  G = (x − x1)·n,  L2 = (e2×n/j)·(x−x1),  L3 = (n×e1/j)·(x−x1),  L1 = 1 − L2 − L3
struct Pair {
  double gap;                     ///< G, mm; negative inside the master
  Vec3<double> normal;            ///< out of the master
  std::array<double, 3> weights;  ///< L of the projection; negative beyond an edge
};

/// The triangle must have an area.
Pair project(const Vec3<double>& x, const Triangle& corners);

/// Distance of a point to one face of a body.
struct FaceGap {
  double gap;           ///< mm; negative behind the face
  Vec3<double> normal;  ///< ∇gap, unit, out of the body
  Mat3<double> bend{};  ///< ∇∇gap, 1/mm
};

}  // namespace bulbus::inline contact
