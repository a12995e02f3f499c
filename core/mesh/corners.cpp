#include "core/mesh/corners.hpp"

#include <numeric>

namespace bulbus::inline mesh {

Corners::Corners(std::span<const Hex> hexes, int nodes) : start_(nodes + 1) {
  for (const Hex& h : hexes)
    for (int n : h) ++start_[n + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  corners_.resize(start_.back());
  for (int h = 0; h < static_cast<int>(hexes.size()); ++h)
    for (int c = 0; c < 8; ++c) corners_[next[hexes[h][c]]++] = Corner(h, c);
}

}  // namespace bulbus::inline mesh
