#pragma once
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "contact/surfaces/facets.hpp"
#include "contact/surfaces/pair.hpp"

namespace bulbus::inline contact {

/// Cosine of 30 degrees: normals that differ by less are of one curved surface, others meet in an edge.
inline constexpr double smooth_edge = 0.86602540378443865;

using CornerNormals = std::array<Vec3<double>, 3>;

/// Normals at the three corners of every triangle: the mean over the triangles around the corner whose planes
/// are within 30 degrees of its own, weighted by area, so that a flat face beside a rounded edge stays flat,
/// times angle at the corner, so that it does not matter how a quad is split. Sharper edges stay edges.
std::vector<CornerNormals> corner_normals(const Facets& facets, std::span<const double> places);

/// Closest-point projection (formulation, section 5.2): that of x on a triangle along the normals
/// interpolated between its corners, x = Σ L_i x_i + g n with n = Σ L_i n_i. The projection, g and n go on
/// from one triangle to the next without a jump where the two share their normals.
struct PointOnNormals {
  std::array<double, 3> weights;  ///< L
  double along;                   ///< g, in lengths of n
  Vec3<double> normal;            ///< n
  std::array<Vec3<double>, 3> inverse;  ///< rows of J⁻¹, J = [∂x/∂L2, ∂x/∂L3, n]: they give δL2, δL3 and δg
};
/// By Newton's method from `flat`, the projection in the triangle's plane; none where that lies farther
/// beyond an edge than the triangle is wide, or it does not converge.
std::optional<PointOnNormals> project_along_normals(const Vec3<double>& x, const Pair& flat,
                                                    const Triangle& corners, const CornerNormals& normals);

/// Distance to the curved surface that a triangle stands for, along its interpolated normals:
///     G = g |n| − Σ_{i<j} s_ij L_i L_j,  s_ij = ½ (n_i − n_j)·(x_i − x_j)
/// Exact to second order on a circle; n/|n| is ∇G to second order in the angle between the corners' normals,
/// the bend the symmetric part of its derivative: positive where the surface is convex. Flat where there is
/// no such projection.
FaceGap smoothed_gap(const Vec3<double>& x, const Pair& flat, const Triangle& corners,
                     const CornerNormals& normals);

/// No gap is farther from that to the flat triangles than this, mm.
double rise(const Facets& facets, std::span<const double> places, std::span<const CornerNormals> normals);

}  // namespace bulbus::inline contact
