#pragma once
#include <array>
#include <vector>

#include "core/solve/coupled_system.hpp"

namespace bulbus::inline precond {

/// The tangent of the terms that floors above added to a problem (contact, sutures), on the next coarser
/// mesh, as a further term of its system: Pᵀ K P with the prolongation P. Without forces: it belongs to the
/// linear system of a coarse level only.
class ProjectedTerm final : public Term {
 public:
  /// Takes what the finer problem's added terms, and the further terms of its system, contribute as they are
  /// linearised.
  void project(const CoupledSystem& finer, const Interpolation& P);

  void add_residual(const State&, std::span<double>, std::span<double>) const override {}
  void linearize(const State&) override {}
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
