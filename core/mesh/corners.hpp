#pragma once
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

/// Corners of the unit cube in the order of a Hex.
inline constexpr int unit_cube[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                        {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

/// The hexahedra around every node, and which of their corners it is.
class Corners {
 public:
  class Corner {
   public:
    Corner() = default;
    Corner(int hex, int corner) : both_(8 * hex + corner) {}
    int hex() const { return both_ / 8; }
    int corner() const { return both_ % 8; }

   private:
    int both_;
  };
  Corners(std::span<const Hex> hexes, int nodes);
  /// Ascending by hexahedra.
  std::span<const Corner> at(int node) const {
    return std::span(corners_).subspan(start_[node], start_[node + 1] - start_[node]);
  }

 private:
  std::vector<int> start_;
  std::vector<Corner> corners_;
};

}  // namespace bulbus::inline mesh
