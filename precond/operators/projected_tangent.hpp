#pragma once
#include <array>
#include <vector>

#include "core/solve/coupled_system.hpp"

namespace bulbus::inline precond {

/// The tangent of the terms that floors above added to a problem (contact, sutures), on the next coarser
/// mesh, as a further tangent of its system: Pᵀ K P with the prolongation P.
class ProjectedTangent final : public TermTangent {
 public:
  /// Of the finer problem's added terms and the further tangents of its system.
  ProjectedTangent(const CoupledSystem& finer, const Interpolation& P);

  void add_action(std::span<const double> dx, std::span<double> force) const override;
  void visit(const ContributionVisitor& visitor) const override;

 private:
  struct Block {
    std::array<int, 2> nodes;  // local
    std::array<double, 9> values;
  };
  void add_up();

  std::vector<Block> blocks_;  // sorted by nodes, each pair once
};

}  // namespace bulbus::inline precond
