#pragma once
#include <memory>

#include "contact/rigid/rigid_surface.hpp"
#include "contact/search/local_search.hpp"
#include "contact/surfaces/master_normals.hpp"
#include "contact/surfaces/sharp_edges.hpp"

namespace bulbus::inline contact {

/// The side that nodes are kept out of: faces of the mesh (one piece), or the parts of a rigid body, each a
/// master of its own.
class Master {
 public:
  /// Corners are local nodes, renumbered to those in use; all triangles on every rank that has slave nodes,
  /// in the same order.
  explicit Master(Facets faces);
  /// `symmetry`: the planes "x", ... in which a body that is drawn up to them goes on as its image.
  explicit Master(std::shared_ptr<const RigidSurface> surface, std::span<const std::string> symmetry = {});

  bool rigid() const { return surface_ != nullptr; }
  bool smooth() const { return surface_ && !surface_->normals.empty(); }
  const Facets& facets() const { return surface_ ? surface_->facets : faces_; }
  int pieces() const { return pieces_; }
  int piece_of(int triangle) const { return piece_[triangle]; }
  /// Of a rigid body until its next motion.
  MasterSurface at(const State& state) const;
  /// Which components of the nodes' normals vanish, as of symmetry planes that they lie on: of each of
  /// nodes().
  void mirror(std::vector<std::array<bool, 3>> components);
  /// ∂n/∂x of the normal at corner `node`, an index of nodes(), of a surface of the mesh.
  std::vector<NormalShare> turning(int node, std::span<const double> places) const {
    return node_normals_->turning(node, places);
  }
  /// How often a rigid body has moved; 0 of a surface of the mesh.
  long moves() const { return surface_ ? surface_->moves : 0; }
  /// Where its corners are, 3 numbers each, mm.
  std::vector<double> places(const State& state) const;
  /// The mesh nodes of its corners, ascending; none of a rigid body.
  const std::vector<int>& nodes() const { return nodes_; }
  /// Triangles that one of a rigid body meets in a sharp convex edge or corner; none of a surface of the
  /// mesh.
  std::span<const int> across_edges(int triangle) const { return edges_.of(triangle); }
  /// The same of sharp concave edges and corners.
  std::span<const int> across_hollows(int triangle) const { return hollows_.of(triangle); }
  /// How many of its faces may keep one point out together.
  int faces_at_a_point() const { return hollows_.empty() ? 1 : 3; }
  /// The mesh node of a corner of a triangle.
  int node(int triangle, int corner) const { return nodes_[faces_.triangles[triangle][corner]]; }

 private:
  Facets faces_;
  std::shared_ptr<const RigidSurface> surface_;
  SharpEdges edges_, hollows_;
  int pieces_ = 1;
  std::vector<int> piece_, nodes_;
  std::optional<MasterNormals> node_normals_;                // of a surface of the mesh
  mutable std::shared_ptr<const EnclosingSpheres> spheres_;  // of a rigid body
  mutable long spheres_after_ = 0;                           // so many moves
};

}  // namespace bulbus::inline contact
