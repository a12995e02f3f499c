#pragma once
#include "precond/amg/scalar_amg.hpp"
#include "precond/coarse/rigid_coarse.hpp"
#include "precond/operators/displacement.hpp"
#include "precond/smoothers/block_jacobi.hpp"
#include "precond/smoothers/chebyshev.hpp"

namespace bulbus::inline precond {

/// The displacement block without its matrix: Chebyshev with block Jacobi on the tangent as it is applied on
/// the fly, before and after one cycle of the three scalar AMGs and a correction with the rigid motions of
/// aggregates. A fixed linear map.
class Hybrid final : public DisplacementPreconditioner {
 public:
  /// `rigid`: none without the rigid motions. Collective.
  Hybrid(const SharedSystem& system, int degree, double lowest, std::shared_ptr<RigidPlan> rigid,
         Precision smoothing);
  int size() const override { return block_->size(); }
  void apply(std::span<const double> b, std::span<double> x) const override;
  bool is_linear() const override { return true; }
  double refresh(SharedSystem system) override {
    block_->refresh(std::move(system));
    return smoother_.refresh();
  }
  void release() override { block_->release(); }
  std::string setup_error() const override {
    return amg_->setup_error() + (coarse_ ? coarse_->setup_error() : "");
  }
  std::size_t bytes() const override;

 private:
  std::shared_ptr<TangentBlock> block_;
  std::shared_ptr<const BlockJacobi> jacobi_;
  Chebyshev smoother_;
  std::unique_ptr<ScalarAmg> amg_;
  std::unique_ptr<RigidCoarse> coarse_;
  mutable std::vector<double> residual_, correction_;
};

}  // namespace bulbus::inline precond
