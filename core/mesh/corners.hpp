#pragma once
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace bulbus {

/// The hexahedra around every node, and which of their corners it is.
class Corners {
 public:
  struct Corner {
    int hex, corner;
  };
  Corners(std::span<const Hex> hexes, int nodes);
  /// Ascending by hexahedra.
  std::span<const Corner> at(int node) const { return std::span(corners_).subspan(start_[node], start_[node + 1] - start_[node]); }

 private:
  std::vector<int> start_;
  std::vector<Corner> corners_;
};

}  // namespace bulbus
