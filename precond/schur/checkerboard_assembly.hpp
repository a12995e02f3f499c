#pragma once
#include "core/mesh/corners.hpp"
#include "precond/schur/checkerboard_matrix.hpp"

namespace bulbus::inline precond {

/// Adds up Σ Fᵀ (L D Lᵀ)⁻¹ F over lines; F: the rows of B P of a line's nodes.
class CheckerboardMatrix::Assembly {
 public:
  /// Tells the owners of nodes what hexahedra of this rank do to them; coarser hexahedra of other ranks
  /// become ghosts. Collective.
  Assembly(const CoupledSystem& system, CheckerboardMatrix& to);
  /// All lines. A first pass finds what they couple, so that no block is ever moved.
  void add_lines(const LineJacobi& lines);
  /// Of this rank, and ghosts.
  int coarser() const { return coarser_; }

 private:
  using Force = Eigen::Matrix<float, 3, Eigen::Dynamic, Eigen::ColMajor, 3, CheckerboardModes::most>;
  // of a coarser hexahedron's modes on a node
  struct NodeForce {
    int node, coarse;
    Force force;
  };
  template <class Use>
  void visit(int node, Use use) const;
  std::vector<NodeForce> sums(int node) const;
  void exchange();
  void receive(std::span<const long long> data, std::span<const int> nodes, std::vector<int>& ghosts);
  void find_columns(std::span<const int> nodes);
  void couple();
  void add(int line, const LineJacobi& lines);
  void constrain(int node, Eigen::Index row);

  const Problem& problem_;
  CheckerboardMatrix& to_;
  int count_, coarser_;  // modes, coarser hexahedra
  Corners corners_;
  std::vector<std::array<float, 24>> constraints_;  // of every hexahedron: ∂V_e/∂u at its corners
  std::vector<NodeForce> foreign_;                  // of other ranks' hexahedra, by nodes
  std::vector<int> columns_;                        // coarser hexahedra that act on a line, ascending
  std::vector<std::vector<int>>
      row_;  // every coarser hexahedron's columns, ascending, until pairs are made of them
  std::vector<std::size_t> start_;  // its first pair
  LineJacobi::Rows F_;
};

}  // namespace bulbus::inline precond
