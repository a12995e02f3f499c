#pragma once
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

/// A mesh with every hexahedron split in eight. The nodes of the coarser mesh come first, under their
/// numbers; a new node is the mean of two, four or eight of them, its parents: the ends of an edge, the
/// corners of a face or those of a hexahedron. Child c of hexahedron h is 8h + c and has h's corner c.
struct RefinedMesh {
  Mesh mesh;
  int coarse_nodes = 0;
  std::vector<int> start;    ///< of the parents of new node coarse_nodes + i
  std::vector<int> parents;  ///< nodes of the coarser mesh

  /// Of any node; its own number if it is a node of the coarser mesh too.
  std::vector<int> parents_of(int node) const;
};

/// New positions: where the mesh has an analytic shape (Mesh::place), at the means of the parents'
/// parameters; else the means of the parents' places. Regions, surfaces and bars carry over; a node set gains
/// the nodes whose parents are all in it, in the order of their parents.
RefinedMesh refine(const Mesh& mesh);

/// A mesh and how many times it is to be refined.
struct MeshHierarchy {
  Mesh base;
  int refinements = 0;
  /// All of the finest mesh.
  Mesh finest() const;
};

inline MeshHierarchy refined(Mesh base, int times) { return {std::move(base), times}; }

}  // namespace bulbus::inline mesh
