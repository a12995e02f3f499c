#pragma once
#include <array>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/solve/triplets.hpp"
#include "precond/coarse/aggregates.hpp"
#include "precond/coarse/distributed_blocks.hpp"

namespace bulbus::inline precond {

/// Six modes of a node: a row per direction, the last two columns zero, so that a row is one vector register.
using NodeModes = std::array<std::array<float, 8>, 3>;

/// Zᵀ A Z, accumulated contribution by contribution: A is never formed. Z are six modes of every aggregate,
/// and rigid bodies as they are. What was ever coupled keeps its place, so that a factorisation finds its
/// pattern again.
class CoarseMatrix {
 public:
  explicit CoarseMatrix(bool symmetric) : symmetric_(symmetric) {}

  /// Everything zero again.
  void clear();
  /// Gives the values back; of no use until clear(). The pattern stays.
  void release();
  /// Gives back what blocks were reserved and not needed.
  void shrink();
  /// Adds a contribution to the reduced displacement block (see for_each_condensed_matrix). `modes`: of every
  /// local node.
  void add(const Aggregates& groups, std::span<const NodeModes> modes, std::span<const int> dofs,
           std::span<const double> K);
  /// A single entry, by numbers of coarse unknowns.
  void add(int row, int column, double value) { block(row / 6, column / 6)[row % 6][column % 6] += value; }
  /// This rank's entries by coarse unknowns, six of every group; the upper triangle if symmetric.
  Triplets triplets() const;
  /// This rank's contributions by numbers of groups, both triangles.
  void visit(const BlockVisitor& visitor) const;
  std::size_t bytes() const;

 private:
  using Block = std::array<std::array<double, 8>, 6>;
  struct Part {
    int group, first;        // coarse group, place among the contribution's dofs
    const NodeModes* modes;  // none of a body
  };
  Block& block(int row, int column);
  void find_parts(const Aggregates& groups, std::span<const NodeModes> modes, std::span<const int> dofs);
  void multiply(std::span<const Part> columns, std::span<const double> K, std::size_t size);
  void gather(const Part& row, int column);

  bool symmetric_;
  std::unordered_map<long long, int> at_;
  std::vector<std::array<int, 2>> places_;
  std::vector<Block> blocks_;
  std::vector<Part> parts_;
  std::vector<std::array<double, 8>> half_;  // K Z of one group
};

}  // namespace bulbus::inline precond
