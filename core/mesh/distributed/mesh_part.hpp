#pragma once
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/refine.hpp"

namespace bulbus::inline mesh {

/// What the nodes and hexahedra of a part are in the whole mesh.
struct Labels {
  std::vector<int> node;  ///< index in the whole; −1 where the part may lack hexahedra around it
  std::vector<int> hex;   ///< index in the whole
  std::vector<int> rank;  ///< to which a hexahedron is given
};

/// Some hexahedra of a mesh. Its nodes, hexahedra, faces, bars and sets keep the order that they have in the
/// whole, and so do those of its refinement.
struct MeshPart {
  Mesh mesh;
  Labels whole;
};

/// Of all of a mesh.
Labels labels_of(const Mesh& mesh, std::span<const int> rank_of_hex);

/// Some hexahedra of a mesh with their nodes.
struct Extract {
  Mesh mesh;
  std::vector<int> nodes, hexes;  ///< indices in the mesh, ascending
};
/// The marked hexahedra and nodes with the faces of surfaces, members of sets and bars between them; every
/// name stays.
Extract extract(const Mesh& mesh, const std::vector<bool>& hexes, std::vector<bool> nodes);

/// What a rank needs of a mesh for its LocalMesh and for those of the refinements: its hexahedra, the faces
/// of the surfaces `shared`, all bars, and every hexahedron that touches a node of these. `mesh` may be such
/// a part already.
MeshPart part_of(const Mesh& mesh, const Labels& whole, int rank, const std::set<std::string>& shared);

}  // namespace bulbus::inline mesh
