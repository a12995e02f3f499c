#pragma once
#include <array>
#include <span>
#include <vector>

#include "contact/surfaces/pair.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline contact {

/// A triangulated surface. Corners are indices of places kept elsewhere (the nodes of a mesh, the points of a
/// rigid body); (x2 − x1) × (x3 − x1) points out of the body.
struct Facets {
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::array<int, 3>> neighbours;  ///< across the edge opposite corner i; −1 at a rim
};

/// Corners of a triangle of a surface whose corners are at `places`, 3 numbers each.
Triangle corners_of(const Facets& facets, std::span<const double> places, int triangle);

/// Finds the neighbours. Throws InputError if an edge belongs to more than two triangles, or if two
/// neighbours disagree on which side is out; `points`, 3 numbers per corner, tell where.
Facets make_facets(std::vector<std::array<int, 3>> triangles, std::span<const double> points = {});

/// Two triangles from every quad, 0-1-2 and 0-2-3: triangles 2i and 2i + 1 are of quad i. Edges may have any
/// number of quads.
std::vector<std::array<int, 3>> triangles_of(std::span<const Quad> quads);

/// The same with their neighbours, as make_facets finds them.
Facets split(std::span<const Quad> quads, std::span<const double> points = {});

}  // namespace bulbus::inline contact
