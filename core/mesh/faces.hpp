#pragma once
#include <vector>

#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

/// Nodes of face `face` = 6·hexahedron + local face, normal out of that hexahedron.
Quad face_nodes(const std::vector<Hex>& hexes, int face);

/// Faces that one hexahedron alone has, ascending; numbered 6·hexahedron + local face.
std::vector<int> outer_faces(const std::vector<Hex>& hexes);

/// Nodes of faces, sorted.
std::vector<int> nodes_of_faces(const std::vector<Quad>& faces);

/// All faces of a list of hexahedra, found by their nodes in any order. Faces are numbered 6·hexahedron +
/// local face.
class FaceTable {
 public:
  explicit FaceTable(const std::vector<Hex>& hexes);
  /// The lowest-numbered face with these four nodes, or -1.
  int first(const Quad& nodes) const;
  /// The face with these nodes whose normal is theirs, or -1.
  int directed(const Quad& nodes) const;
  /// How many hexahedra have a face with these nodes.
  int count(const Quad& nodes) const;

 private:
  const std::vector<Hex>* hexes_;
  std::vector<std::size_t> start_;  ///< per node, the first entry of the faces whose lowest node it is
  std::vector<int> entries_;
};

}  // namespace bulbus::inline mesh
