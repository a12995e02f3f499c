#pragma once
#include <span>

#include "core/base/tensor.hpp"

namespace bulbus {

/// Distance of a point to one of the faces that meet in an edge or a corner.
struct FaceGap {
  double gap;           ///< mm; negative behind the face
  Vec3<double> normal;  ///< ∇gap, unit, out of the body
  Mat3<double> bend{};  ///< ∇∇gap, 1/mm
};

/// Distance to the body that the faces bound together, its edges and corners rounded with `radius` ϱ, mm: that to the body which is
/// smaller by ϱ on all sides, less ϱ,
///     G = min |y| − ϱ,  n_i·y ≥ ϱ + G_i for all faces i
/// so that G and its gradient are continuous across a convex edge, and a point on the edge is pushed along the mean of the normals. Deeper
/// than ϱ the nearest face decides, faces that are equally near together. At least one face; faces whose normals are alike count once.
FaceGap rounded_gap(std::span<const FaceGap> faces, double radius);

}  // namespace bulbus
