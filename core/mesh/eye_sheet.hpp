#pragma once
#include <array>
#include <vector>

#include "core/mesh/eye.hpp"

namespace bulbus {

/// The eye's outer surface as a grid, from pole to pole: a half disc with the nerve's section, rings, a half
/// disc with the cornea. Every node is the head of a column through the layers.
struct EyeSheet {
  struct Node {
    double t;     ///< meridian coordinate, degrees
    double x, y;  ///< azimuth: cosines to x and y; x is exactly 0 on the plane of symmetry
  };
  std::vector<Node> nodes;
  std::vector<std::array<int, 4>> quads;  ///< normals outwards
  int nerve_nodes = 0, nerve_quads = 0;   ///< the first of each lie under the nerve
  std::vector<int> nerve_ring;            ///< the ring next to the nerve's edge
  int posterior_pole = 0, anterior_pole = 0;

  /// Mean t of a quad's nodes.
  double middle(int quad) const;
};

EyeSheet eye_sheet(const EyeSettings& settings);

/// A count that is `base` at n = 14, in proportion to n, and 1 at least.
int scaled(int base, int n);

}  // namespace bulbus
