#pragma once
#include <span>

#include "contact/surfaces/pair.hpp"

namespace bulbus::inline contact {

/// Distance to the body that the faces bound together, its edges and corners rounded with `radius` ϱ, mm:
/// that to the body which is smaller by ϱ on all sides, less ϱ,
///     G = min |y| − ϱ,  n_i·y ≥ ϱ + G_i for all faces i
/// so that G and its gradient are continuous across a convex edge, and a point on the edge is pushed along
/// the mean of the normals. Deeper than ϱ the nearest face decides, faces that are equally near together. At
/// least one face; faces whose normals are alike count once.
FaceGap rounded_gap(std::span<const FaceGap> faces, double radius);

}  // namespace bulbus::inline contact
