#pragma once
#include <optional>
#include <span>

#include "contact/surfaces/smoothed_facets.hpp"

namespace bulbus::inline contact {

/// Part of a triangle's height, in weights, by which contact reaches past a rim of a deformable master. Less
/// of it lets the force of a point that slides off end more steeply, more adds contact where no surface is.
inline constexpr double fading_rim = 0.25;

/// A slave point and its projection on a triangle of a deformable master, along the normals interpolated
/// between its corners (project_along_normals). Gap, direction and shares go on from one triangle to the next
/// without a jump, and so does the contact's force
///     −A φ p [n/|n|; −L_i n/|n|],  G = g |n|
struct NormalProjection {
  PointOnNormals projection;
  Pair pair;     ///< gap G, unit normal, weights L
  double cover;  ///< φ: part of the point's area that lies on the master: 1, past a rim falling to 0 within
                 ///< fading_rim
  Vec3<double> fading;  ///< ∂φ/∂L
};
/// `neighbours` of the triangle: −1 at a rim. None where there is no projection along the normals.
std::optional<NormalProjection> project_along_normals(const Vec3<double>& x, const Pair& flat,
                                                      const Triangle& corners, const CornerNormals& normals,
                                                      const std::array<int, 3>& neighbours);

/// A displaced node of a contact: how its displacement moves the slave point and the three corners, and turns
/// the corners' normals.
struct ContactColumn {
  double carries = 0;                   ///< w_k of a node that carries the slave point
  std::array<double, 3> corners{};      ///< 1 for the corner that it is
  std::array<Mat3<double>, 3> turns{};  ///< ∂n_i/∂x
};
struct ContactStiffness {
  double area, penalty, pressure;  ///< A φ, mm²; −∂p/∂G, MPa/mm; p, MPa
};
/// K += ∂(force)/∂x of all columns by all columns, 3k × 3k by rows; not symmetric. The slave point's own
/// normal, where it has a chordal offset, is held.
void add_tangent(const NormalProjection& at, const CornerNormals& normals,
                 std::span<const ContactColumn> columns, const ContactStiffness& stiffness,
                 std::span<double> K);

}  // namespace bulbus::inline contact
