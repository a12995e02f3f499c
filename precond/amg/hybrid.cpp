#include "precond/amg/hybrid.hpp"

#include "core/base/memory.hpp"
#include "core/solve/reduced.hpp"
#include "precond/amg/scalar_matrices.hpp"
#include "precond/operators/correct.hpp"
#include "precond/smoothers/line_jacobi.hpp"

namespace bulbus::inline precond {

Hybrid::Hybrid(const SharedSystem& system, int degree, double lowest, std::shared_ptr<RigidPlan> rigid,
               Precision smoothing)
    : block_(displacement_block(system, smoothing)),
      jacobi_(std::make_shared<BlockJacobi>(*system)),
      smoother_(block_, jacobi_, degree, lowest, system->problem().comm()),
      amg_(std::make_unique<ScalarAmg>(*system, scalar_matrices(*system), *jacobi_)),
      residual_(block_->size()),
      correction_(block_->size()) {
  if (!rigid) return;
  coarse_ = std::make_unique<RigidCoarse>(*system, std::move(rigid));
  for_each_condensed_matrix(
      *system, matrices_of(smoothing),
      [&](std::span<const int> dofs, std::span<const double> K) { coarse_->add(dofs, K); });
  coarse_->factorise(*system, {});
}

void Hybrid::apply(std::span<const double> b, std::span<double> x) const {
  smoother_.apply(b, x);
  correct(*block_, *amg_, b, x, residual_, correction_);
  if (coarse_) correct(*block_, *coarse_, b, x, residual_, correction_);
  correct(*block_, smoother_, b, x, residual_, correction_);
}

std::size_t Hybrid::bytes() const {
  return jacobi_->bytes() + smoother_.bytes() + amg_->bytes() + (coarse_ ? coarse_->bytes() : 0) +
         bytes_of(residual_) + bytes_of(correction_);
}

}  // namespace bulbus::inline precond
