#pragma once
#include <array>
#include <span>
#include <vector>

#include "contact/facets.hpp"
#include "contact/pair.hpp"

namespace bulbus {

/// Cosine of 30 degrees: normals that differ by less are of one curved surface, others meet in an edge.
inline constexpr double smooth_edge = 0.86602540378443865;

using CornerNormals = std::array<Vec3<double>, 3>;

/// Normals at the three corners of every triangle: the mean over the triangles around the corner whose planes are within
/// 30 degrees of its own, weighted by their areas, so that a flat face beside a rounded edge stays flat. Sharper edges stay
/// edges.
std::vector<CornerNormals> corner_normals(const Facets& facets, std::span<const double> places);

/// Distance to the curved surface that a triangle stands for, quadratic in the place of the foot:
///     G = G_flat − Σ_{i<j} s_ij L_i L_j,  s_ij = ½ (n_i − n_j)·(x_i − x_j)
/// Exact to second order on a circle; from one triangle to the next G and its gradient go on up to third order. Flat where the foot
/// lies farther beyond an edge than the triangle is wide.
struct CurvedGap {
  double gap;             ///< G, mm; negative inside
  Vec3<double> gradient;  ///< ∇G, a unit vector to second order
  Mat3<double> bend;      ///< ∇∇G (1/mm): positive where the surface is convex
};
CurvedGap curved_gap(const Pair& flat, const Triangle& corners, const CornerNormals& normals);

/// No gap is farther from that to the flat triangles than this, mm.
double rise(const Facets& facets, std::span<const double> places, std::span<const CornerNormals> normals);

}  // namespace bulbus
