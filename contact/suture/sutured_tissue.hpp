#pragma once
#include <vector>

#include "core/mesh/distributed/local_mesh.hpp"
#include "core/problem/spec/rigid_spec.hpp"

namespace bulbus::inline contact {

/// The nodes that a suture may hold, of all ranks.
struct SuturedTissue {
  Mesh mesh;               ///< its surface and sets; others have their names only
  std::vector<int> input;  ///< of a node, its index in the Mesh that was distributed; ascending
};

/// The suture's surface, shared by all ranks, and its sets, gathered. The same on every rank. Collective.
SuturedTissue sutured_tissue(const LocalMesh& mesh, const SutureSpec& spec);

}  // namespace bulbus::inline contact
