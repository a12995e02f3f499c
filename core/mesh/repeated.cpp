#include "core/mesh/repeated.hpp"

#include <algorithm>

#include "core/mesh/sorted.hpp"

namespace bulbus::inline mesh {

std::vector<std::pair<int, int>> repeated(const std::vector<Hex>& hexes) {
  int nodes = 0;
  for (const Hex& h : hexes) nodes = std::max(nodes, 1 + *std::ranges::max_element(h));
  std::vector<int> last(nodes, -1), before(hexes.size());  // per lowest node, a chain of its hexahedra
  std::vector<std::pair<int, int>> found;
  for (int i = 0; i < static_cast<int>(hexes.size()); ++i) {
    const int low = *std::ranges::min_element(hexes[i]);
    int first = -1;
    for (int j = last[low]; j >= 0; j = before[j])
      if (sorted(hexes[j]) == sorted(hexes[i])) first = j;
    before[i] = last[low];
    last[low] = i;
    if (first >= 0) found.emplace_back(first, i);
  }
  return found;
}

}  // namespace bulbus::inline mesh
