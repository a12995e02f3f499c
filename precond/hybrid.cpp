#include "precond/hybrid.hpp"

#include "core/base/memory.hpp"
#include "precond/scalar_matrices.hpp"

namespace bulbus {

Hybrid::Hybrid(const CoupledSystem& system, int degree, double lowest, int aggregates)
    : block_(system),
      jacobi_(system),
      smoother_(block_, jacobi_, degree, lowest, system.problem().comm()),
      residual_(block_.size()),
      correction_(block_.size()) {
  const auto scalar = scalar_matrices(system);
  amg_ = std::make_unique<ScalarAmg>(system, scalar, jacobi_);
  if (aggregates > 0) coarse_ = std::make_unique<RigidCoarse>(system, scalar, aggregates);
}

void Hybrid::correct(const Preconditioner& by, std::span<const double> b, std::span<double> x) const {
  block_.apply(x, residual_);
  for (std::size_t i = 0; i < residual_.size(); ++i) residual_[i] = b[i] - residual_[i];
  by.apply(residual_, correction_);
  for (std::size_t i = 0; i < residual_.size(); ++i) x[i] += correction_[i];
}

void Hybrid::apply(std::span<const double> b, std::span<double> x) const {
  smoother_.apply(b, x);
  correct(*amg_, b, x);
  if (coarse_) correct(*coarse_, b, x);
  correct(smoother_, b, x);
}

std::size_t Hybrid::bytes() const {
  return jacobi_.bytes() + smoother_.bytes() + amg_->bytes() + (coarse_ ? coarse_->bytes() : 0) + bytes_of(residual_) + bytes_of(correction_);
}

}  // namespace bulbus
