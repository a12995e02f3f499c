#pragma once
#include <string>
#include <vector>

#include "core/element/solid.hpp"
#include "core/mesh/distributed/local_mesh.hpp"

namespace bulbus::inline problem {

/// Connected parts of the hexahedra of these regions, over all ranks: hexahedra that share a node belong to
/// one.
struct ConnectedParts {
  int count = 0;                   ///< the same on every rank
  std::vector<int> of_node;        ///< of every local node, −1: none of these regions
  std::vector<std::string> names;  ///< regions of a part, joined by " and "
};

/// Collective.
ConnectedParts connected_parts(const LocalMesh& mesh, const std::vector<SolidRegion>& regions);

}  // namespace bulbus::inline problem
