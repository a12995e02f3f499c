#pragma once
#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace bulbus::inline mesh {

using Point = std::array<double, 3>;  ///< mm
/// Four nodes of a face; the normal (∂x/∂ξ × ∂x/∂η over 0-1-2-3) points OUT of the hexahedron it belongs to.
using Quad = std::array<int, 4>;
/// Eight nodes in the order of Gmsh and VTK: 0-1-2-3 below, 4-5-6-7 above, positive volume.
using Hex = std::array<int, 8>;

/// A point that rides on a face or sits in a node (one weight 1, the others 0): x = Σ weight_i x(node_i).
struct EmbeddedPoint {
  std::array<int, 4> nodes{};
  std::array<double, 4> weights{};
};

/// A straight bar between two embedded points; `share` is the part of its area that the model owns (½ on a
/// symmetry plane).
struct Bar {
  EmbeddedPoint a, b;
  double share = 1;
};

/// Where a node is in the lattice of a generated shape; what the numbers mean is the shape's own.
using Parameters = std::array<double, 5>;

/// A hexahedral mesh with its names: what is read or generated, whole on every rank, or a rank's part of its
/// refinement.
struct Mesh {
  std::vector<Point> points;
  std::vector<Hex> hexes;
  std::vector<int> region;  ///< per hexahedron, an index of region_names
  std::vector<std::string> region_names;
  std::map<std::string, std::vector<Quad>> surfaces;
  std::map<std::string, std::vector<int>> node_sets;
  std::map<std::string, std::vector<Bar>> bars;
  std::vector<Parameters> parameters;  ///< per node of a generated shape that is curved; else empty
  std::function<Point(const Parameters&)>
      place;  ///< the analytic shape: between nodes, parameters are linear
};

/// Adds the node that the mesh's shape has at these parameters.
int add_node(Mesh& mesh, const Parameters& parameters);

/// The six faces of a hexahedron as local node numbers, normals outwards.
extern const std::array<std::array<int, 4>, 6> hex_faces;

/// Faces that belong to one hexahedron only, with normals out of the mesh; hexahedron k of `owner` has face
/// i.
std::vector<Quad> boundary_faces(const Mesh& mesh, std::vector<int>* owner = nullptr);

/// Nodes of a named set: a node set, or all nodes of a surface or of a region of that name. Sorted.
/// Throws InputError with the nearest name if there is none, and where several of these have the name and
/// other nodes.
std::vector<int> nodes_of(const Mesh& mesh, const std::string& name);

/// Nodes of the hexahedra of a region. Sorted.
std::vector<int> nodes_of_region(const Mesh& mesh, int region);

/// Index in region_names, or -1.
int region_index(const Mesh& mesh, const std::string& name);

}  // namespace bulbus::inline mesh
