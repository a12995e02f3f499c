#pragma once
#include <vector>

#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

/// Rank (0 to parts − 1) of each hexahedron, by METIS on the graph of cells that share a face. The same mesh
/// gives the same answer always, so every rank may compute it for itself. Throws InputError if there are more
/// parts than cells.
std::vector<int> partition(const Mesh& mesh, int parts);

}  // namespace bulbus::inline mesh
