#pragma once
#include "contact/surfaces/smoothed_facets.hpp"

namespace bulbus::inline contact {

/// What the displacement of a node adds to a unit normal: δN = turn · δx (1/mm).
struct NormalShare {
  int node;
  Mat3<double> turn;
};

/// Unit normals at the nodes of a master surface of quadrilaterals, where it is now: the mean over the faces
/// around a node, weighted by area,
///     n ∥ Σ ½ (x2 − x0) × (x3 − x1)
/// A node on a symmetry plane has no component across it, as if the mirrored faces were there.
class MasterNormals {
 public:
  /// `facets` as of split(): triangles 2i and 2i + 1 are of quadrilateral i. `mirrored`: of each node.
  MasterNormals(const Facets& facets, std::vector<std::array<bool, 3>> mirrored);
  /// At the three corners of every triangle; `places`: 3 per node.
  std::vector<CornerNormals> at_corners(std::span<const double> places) const;
  /// ∂n/∂x of the normal at a node.
  std::vector<NormalShare> turning(int node, std::span<const double> places) const;

 private:
  Vec3<double> sum(int node, std::span<const double> places) const;

  std::vector<std::array<int, 3>> triangles_;
  std::vector<Quad> faces_;
  std::vector<std::vector<int>> around_;  // faces of each node
  std::vector<std::array<bool, 3>> mirrored_;
};

}  // namespace bulbus::inline contact
