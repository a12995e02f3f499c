#pragma once
#include <memory>

#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_operator.hpp"
#include "core/solve/settings.hpp"
#include "precond/smoothers/line_jacobi.hpp"

namespace bulbus {

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

/// An approximate inverse of the displacement block, on primal vectors, and the lines it smooths with; null
/// where it has none.
struct DisplacementInverse {
  std::shared_ptr<Preconditioner> inverse;
  const LineJacobi* lines = nullptr;
  bool factors_kept = false;  ///< those of its coarsest matrix are an earlier linearisation's
};

/// Makes the preconditioner of the displacement block that the settings name, of every linearisation of one
/// problem anew.
class DisplacementFactory {
 public:
  explicit DisplacementFactory(const LinearSettings& settings);
  ~DisplacementFactory();
  /// Collective. Throws InputError where hypre's or MUMPS's numbering ends, and for multigrid without a
  /// refined mesh. `keep_factors`: where the coarsest matrix has hardly changed.
  DisplacementInverse make(const CoupledSystem& system, bool keep_factors = false);

 private:
  LinearSettings settings_;
  struct Plans;  // what they keep from one linearisation to the next
  std::unique_ptr<Plans> plans_;
};

}  // namespace bulbus
