#pragma once
#include <memory>

#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_operator.hpp"
#include "core/solve/mumps.hpp"
#include "core/solve/settings.hpp"
#include "precond/operators/displacement_preconditioner.hpp"

namespace bulbus::inline precond {

/// The augmented displacement block K + γ B W Bᵀ as an operator on primal vectors.
class DisplacementBlock final : public LinearOperator {
 public:
  explicit DisplacementBlock(const CoupledSystem& system) : system_(system) {}
  int size() const override { return system_.layout().primal(); }
  void apply(std::span<const double> x, std::span<double> y) const override {
    system_.apply_displacement(x, y);
  }

 private:
  const CoupledSystem& system_;
};

/// The block, or in single precision what smoothers take for it.
std::unique_ptr<LinearOperator> displacement_block(const CoupledSystem& system, Precision precision);

/// Makes the preconditioner of the displacement block that the settings name, of every linearisation of one
/// problem anew.
class DisplacementFactory {
 public:
  explicit DisplacementFactory(const LinearSettings& settings);
  ~DisplacementFactory();
  /// Collective. Throws InputError where hypre's or MUMPS's numbering ends, and for multigrid without a
  /// refined mesh. `keep`: the coarsest matrix's factors.
  std::unique_ptr<DisplacementPreconditioner> make(const CoupledSystem& system, const KeepFactors& keep = {});
  /// From now on aggregation factorises its coarse matrix, however large it is.
  void factorise_coarse();

 private:
  LinearSettings settings_;
  struct Plans;  // what they keep from one linearisation to the next
  std::unique_ptr<Plans> plans_;
};

}  // namespace bulbus::inline precond
