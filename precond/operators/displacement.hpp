#pragma once
#include <memory>

#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_operator.hpp"
#include "core/solve/mumps.hpp"
#include "core/solve/settings.hpp"
#include "precond/operators/displacement_preconditioner.hpp"

namespace bulbus::inline precond {

/// A linearisation's augmented displacement block K + γ B W Bᵀ, on primal vectors, applied on the fly.
class TangentBlock : public LinearOperator {
 public:
  /// The block of another linearisation of the problem from now on. Collective.
  virtual void refresh(SharedSystem system) = 0;
  /// Gives the linearisation up; of no use until it is refreshed.
  virtual void release() = 0;
};

/// As it is.
class DisplacementBlock final : public TangentBlock {
 public:
  explicit DisplacementBlock(SharedSystem system)
      : size_(system->layout().primal()), system_(std::move(system)) {}
  int size() const override { return size_; }
  void apply(std::span<const double> x, std::span<double> y) const override {
    system_->apply_displacement(x, y);
  }
  void refresh(SharedSystem system) override { system_ = std::move(system); }
  void release() override { system_.reset(); }

 private:
  int size_;
  SharedSystem system_;
};

/// The block, or in single precision what smoothers take for it.
std::unique_ptr<TangentBlock> displacement_block(SharedSystem system, Precision precision);

/// Makes the preconditioner of the displacement block that the settings name, of every linearisation of one
/// problem anew.
class DisplacementFactory {
 public:
  explicit DisplacementFactory(const LinearSettings& settings);
  ~DisplacementFactory();
  /// Collective. Throws InputError where hypre's or MUMPS's numbering ends, and for multigrid without a
  /// refined mesh. `keep`: the coarsest matrix's factors.
  std::unique_ptr<DisplacementPreconditioner> make(SharedSystem system, const KeepFactors& keep = {});
  /// From now on aggregation factorises its coarse matrix, however large it is.
  void factorise_coarse();

 private:
  LinearSettings settings_;
  struct Plans;  // what they keep from one linearisation to the next
  std::unique_ptr<Plans> plans_;
};

}  // namespace bulbus::inline precond
