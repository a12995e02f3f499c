#pragma once
#include <array>
#include <span>
#include <vector>

#include "contact/facets.hpp"
#include "contact/pair.hpp"

namespace bulbus {

using CornerNormals = std::array<Vec3<double>, 3>;

/// Normals at the three corners of every triangle: the mean over the triangles around the corner whose planes are within
/// `sharpest` degrees of its own, weighted by their areas, so that a flat face beside a rounded edge stays flat. Sharper edges stay
/// edges.
std::vector<CornerNormals> corner_normals(const Facets& facets, std::span<const double> places, double sharpest = 30);

/// The normal field of the curved surface that the triangles stand for, at the foot of a node.
struct SmoothNormal {
  Vec3<double> normal;  ///< n = Σ L_i n_i / |Σ L_i n_i|
  Mat3<double> bend;    ///< ∇n across n, symmetric part (1/mm): positive where the master is convex
};
SmoothNormal smooth_normal(const Pair& pair, const CornerNormals& corners);

}  // namespace bulbus
