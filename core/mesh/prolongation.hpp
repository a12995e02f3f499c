#pragma once
#include <functional>
#include <span>
#include <vector>

#include "core/mesh/distributed/local_mesh.hpp"
#include "core/mesh/refine.hpp"

namespace bulbus::inline mesh {

/// A linear map from nodal vectors (3 numbers per local node) of one rank's part of a mesh to those of its
/// part of the refined one.
class Interpolation {
 public:
  struct Stencil {
    std::span<const int> nodes;  ///< coarser local nodes
    std::span<const float> weights;
  };
  /// Of a local node; empty for a ghost of which this rank does not know the parents.
  Stencil stencil(int fine_node) const;
  /// fine = I coarse on owned nodes; ghosts of `coarse` have to be right.
  void apply(std::span<const double> coarse, std::span<double> fine) const;
  /// coarse = Iᵀ fine, from owned nodes, accumulated on the owners. Collective.
  void apply_transposed(std::span<const double> fine, std::span<double> coarse) const;
  std::size_t bytes() const;

 private:
  friend class Prolongation;
  Interpolation(int owned, const Halo& coarse_halo) : owned_(owned), coarse_halo_(coarse_halo) {}
  void add(int node, double weight);

  int owned_;
  Halo coarse_halo_;
  std::vector<int> start_{0}, nodes_;
  std::vector<float> weights_;
};

/// How one rank's parts of a mesh and of the refined one hang together; hexahedra lie on the ranks of their
/// parents.
class Prolongation {
 public:
  /// `parents_of`: those of a node of the finer Mesh, in the coarser. The local meshes have to stay where
  /// they are.
  using ParentsOf = std::function<std::vector<int>(int)>;
  Prolongation(const ParentsOf& parents_of, const LocalMesh& coarse, const LocalMesh& fine);
  Prolongation(const RefinedMesh& whole, const LocalMesh& coarse, const LocalMesh& fine)
      : Prolongation([&](int n) { return whole.parents_of(n); }, coarse, fine) {}

  /// Trilinear in a hexahedron around the node, extended to where the node really is: a curved surface lies
  /// beside the coarser faces, and with plain means of the parents a rigid rotation would strain it. Linear
  /// fields of the positions are reproduced.
  ///     w_a = N_a(ξ) + ∇N_a(ξ)·(∂x/∂ξ)⁻¹ (x_fine − x(ξ)),   ξ amid the parents
  /// `x`: positions on both meshes; `stiffness` per coarser hexahedron: the stiffest around a node is taken.
  Interpolation at(std::span<const double> coarse_x, std::span<const double> fine_x,
                   std::span<const double> stiffness) const;
  /// coarse = fine at the coarser nodes. Collective.
  void inject(std::span<const double> fine, std::span<double> coarse) const;
  std::size_t bytes() const;

 private:
  const LocalMesh& coarse_;
  const LocalMesh& fine_;
  std::vector<int> same_;  // fine node at every owned coarser node
  std::vector<int> lone_start_,
      lone_parents_;  // parents of ghosts that no hexahedron of this rank has, from first_lone_ on
  int first_lone_;
};

}  // namespace bulbus::inline mesh
