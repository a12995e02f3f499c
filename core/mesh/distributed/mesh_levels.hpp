#pragma once
#include <memory>

#include "core/mesh/prolongation.hpp"

namespace bulbus::inline mesh {

/// One rank's part of a mesh of a hierarchy.
struct MeshLevel {
  std::unique_ptr<LocalMesh> mesh;
  std::unique_ptr<const Prolongation> prolongation;  ///< from the level below; the base has none
};

/// A mesh, given to the ranks by partition(), and its refinements; hexahedra stay where their parents are.
/// Every rank refines only its part. The finest last. Collective.
std::vector<MeshLevel> distribute_levels(const Mesh& base, int refinements, const Comm& comm,
                                         const std::set<std::string>& shared);

/// Gives the finest mesh other reference positions, 3 per local node, ghosts included, and the coarser ones
/// those of their nodes; what was drawn is kept. Collective.
void move_reference(std::vector<MeshLevel>& levels, std::vector<double> X);

}  // namespace bulbus::inline mesh
