#pragma once
#include <span>
#include <vector>

#include "core/mesh/local_mesh.hpp"
#include "core/mesh/refine.hpp"

namespace bulbus {

/// Trilinear interpolation from one rank's part of a mesh to its part of the refined one, whose hexahedra lie on the ranks of
/// their parents. Nodal vectors have 3 numbers per local node.
class Prolongation {
 public:
  Prolongation(const RefinedMesh& refinement, const LocalMesh& coarse, const LocalMesh& fine);

  /// fine = I coarse on owned nodes; ghosts of `coarse` have to be right.
  void interpolate(std::span<const double> coarse, std::span<double> fine) const;
  /// coarse = Iᵀ fine, from owned nodes, folded to the owners. Collective.
  void restricted(std::span<const double> fine, std::span<double> coarse) const;
  /// coarse = fine at the coarser nodes. Collective.
  void inject(std::span<const double> fine, std::span<double> coarse) const;
  /// Local coarser nodes of which a local node is the mean; none for a ghost whose parents this rank does not have.
  std::span<const int> parents(int fine_node) const;
  std::size_t bytes() const;

 private:
  int owned_, coarse_owned_;
  Halo coarse_halo_;
  std::vector<int> start_, parents_;
  std::vector<int> same_;  // fine node at every owned coarser node
};

}  // namespace bulbus
