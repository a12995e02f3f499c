#pragma once
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace bulbus {

/// A mesh with every hexahedron split in eight. The nodes of the coarser mesh come first, under their numbers; a new node is the
/// mean of two, four or eight of them, its parents: the ends of an edge, the corners of a face or those of a hexahedron.
/// Child c of hexahedron h is 8h + c and has h's corner c.
struct RefinedMesh {
  Mesh mesh;
  int coarse_nodes = 0;
  std::vector<int> start;    ///< of the parents of new node coarse_nodes + i
  std::vector<int> parents;  ///< nodes of the coarser mesh

  /// Of any node; its own number if it is a node of the coarser mesh too.
  std::vector<int> parents_of(int node) const;
};

/// New places: where the mesh has an analytic shape (Mesh::place), at the means of the parents' parameters; else the means of the
/// parents' places. Regions, surfaces and bars carry over; a node set gains the nodes whose parents are all in it, in the order
/// of their parents.
RefinedMesh refine(const Mesh& mesh);

/// A mesh and its refinements, the finest last.
struct MeshHierarchy {
  Mesh base;
  std::vector<RefinedMesh> refinements;
  const Mesh& mesh(std::size_t level) const { return level == 0 ? base : refinements[level - 1].mesh; }
  const Mesh& finest() const { return mesh(refinements.size()); }
};

/// Refines `times` times.
MeshHierarchy refined(Mesh base, int times);

}  // namespace bulbus
