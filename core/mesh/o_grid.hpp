#pragma once
#include <array>
#include <vector>

namespace bulbus {

/// A disc of quads: a square core of cells whose outline is rounded half way to a circle, and rings around
/// it.
struct Disc {
  /// A place in the unit disc: distance from the centre and direction (cosine to x, cosine to y). Where the
  /// disc is cut, x is exactly 0.
  struct Node {
    double radius;
    double x, y;
  };
  std::vector<Node> nodes;
  std::vector<std::array<int, 4>> quads;  ///< counter-clockwise in the x-y plane
  /// Nodes on the circle. Whole: 8n, counter-clockwise. Half: 4n + 1 from +y over +x to −y.
  std::vector<int> rim;
};

/// Core of 2n × 2n cells (half: n × 2n with x >= 0) of half edge `core`, and `rings` rings; the rim's angles
/// are equal.
Disc o_grid(int n, int rings, double core, bool half);

}  // namespace bulbus
