#pragma once
#include <array>
#include <vector>

namespace bulbus::inline mesh {

/// The unit disc as the image of a lattice: a square core −n..n × −n..n whose outline is rounded half way to
/// a circle, and `rings` rings between the outline and the circle.
struct DiscMap {
  int n, rings;
  double core;  ///< half edge of the core

  /// A place in the unit disc: distance from the centre and direction (cosine to x, cosine to y).
  struct Place {
    double radius, x, y;
  };
  /// Of a lattice point of the core, or of its outline `ring` rings further out; any of them may lie between
  /// the integers. Exact where i is 0, and on the circle.
  Place operator()(double i, double j, double ring) const;
};

/// A disc of quads made of whole lattice points.
struct Disc {
  struct Node : DiscMap::Place {
    int i, j, ring;
  };
  std::vector<Node> nodes;
  std::vector<std::array<int, 4>> quads;  ///< counter-clockwise in the x-y plane
  /// Nodes on the circle. Whole: 8n, counter-clockwise. Half: 4n + 1 from +y over +x to −y.
  std::vector<int> rim;
};

/// Core of 2n × 2n cells (half: n × 2n with x >= 0) and rings; the rim's angles are equal.
Disc o_grid(const DiscMap& map, bool half);

}  // namespace bulbus::inline mesh
