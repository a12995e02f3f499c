#pragma once
#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_operator.hpp"
#include "core/solve/mumps.hpp"
#include "precond/coarse/block_hierarchy.hpp"
#include "precond/coarse/rigid_modes.hpp"

namespace bulbus::inline precond {

/// What the correction with rigid motions keeps from one linearisation to the next: the aggregates, the
/// pattern of the coarse matrix and its analysis.
struct RigidPlan {
  /// Aggregates of about `nodes` nodes, factors of this precision; a matrix of more than `most` unknowns
  /// is not factorised but has levels of its own, as long as single precision suffices. Collective.
  RigidPlan(const CoupledSystem& system, int nodes, Precision precision, int most);
  /// Is it of use for the problem as it is now? Not where the tangent is no more, or now, symmetric, a node
  /// has been released that no aggregate holds, or factors are to be more precise. Collective.
  bool fits(const Problem& problem, Precision wanted) const;
  bool symmetric;
  Precision precision;
  Aggregates groups;
  CoarseMatrix matrix;
  Mumps factor;
  std::shared_ptr<HierarchyPlan> levels;  ///< none: the matrix is factorised
};

/// Galerkin correction on the rigid motions of aggregates in the current configuration: the bending and
/// tilting that smoothers and scalar AMG cannot see. x = Z (Zᵀ A Z)⁻¹ Zᵀ b; the coarse matrix may be
/// indefinite. Its inverse is a factorisation, or the approximate one of BlockHierarchy
/// where that is stable. Rigid bodies are
/// coarse unknowns as they are. One per plan at a time. Usage: add() everything of for_each_condensed_matrix,
/// then factorise().
class RigidCoarse final : public Preconditioner {
 public:
  /// Collective.
  RigidCoarse(const CoupledSystem& system, std::shared_ptr<RigidPlan> plan);
  void add(std::span<const int> dofs, std::span<const double> K) {
    plan_->matrix.add(plan_->groups, modes_.of, dofs, K);
  }
  /// `system`: the same. Collective.
  void factorise(const CoupledSystem& system, const KeepFactors& keep);
  /// Are the factors those of an earlier linearisation?
  bool keeps_factors() const { return keeps_factors_; }
  /// Are there levels of a matrix that is small enough for MUMPS?
  bool could_be_factorised() const;
  int size() const override { return layout_.primal(); }
  void apply(std::span<const double> b, std::span<double> x) const override;
  bool is_linear() const override { return true; }
  std::string setup_error() const override { return setup_error_; }
  std::size_t bytes() const override;
  /// Coarse unknowns of all ranks.
  int coarse_size() const { return 6 * plan_->groups.total; }

 private:
  bool make_levels(const CoupledSystem& system, const std::vector<RigidFrame>& frames);

  Layout layout_;
  std::shared_ptr<RigidPlan> plan_;
  RigidModes modes_;
  mutable std::vector<double> coarse_;
  std::unique_ptr<BlockHierarchy> levels_;
  std::string setup_error_;
  bool keeps_factors_ = false;
  std::size_t factor_bytes_ = 0;
};

}  // namespace bulbus::inline precond
