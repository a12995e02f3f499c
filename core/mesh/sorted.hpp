#pragma once
#include <algorithm>

namespace bulbus::inline mesh {

/// The nodes of an edge, a face or a hexahedron in ascending order: the same for all that have the same
/// nodes.
template <class Nodes>
Nodes sorted(Nodes nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

}  // namespace bulbus::inline mesh
