#pragma once
#include <memory>

#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_operator.hpp"
#include "core/solve/settings.hpp"

namespace bulbus {

/// The augmented displacement block K + γ B W Bᵀ as an operator on primal vectors.
class DisplacementBlock final : public LinearOperator {
 public:
  explicit DisplacementBlock(const CoupledSystem& system) : system_(system) {}
  int size() const override { return system_.layout().primal(); }
  void apply(std::span<const double> x, std::span<double> y) const override { system_.apply_displacement(x, y); }

 private:
  const CoupledSystem& system_;
};

/// The preconditioner of the displacement block that the settings name: `hybrid`, `scalar_amg`, `boomeramg`,
/// `boomeramg_nodal`, `jacobi` or `exact`. Works on primal vectors. Collective. Throws InputError where hypre's or MUMPS's
/// numbering ends.
std::unique_ptr<Preconditioner> make_displacement_preconditioner(const CoupledSystem& system, const LinearSettings& settings);

}  // namespace bulbus
