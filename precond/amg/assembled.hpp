#pragma once
#include <memory>

#include "core/solve/coupled_system.hpp"
#include "core/solve/mumps.hpp"
#include "precond/amg/boomeramg.hpp"
#include "precond/smoothers/block_jacobi.hpp"

namespace bulbus::inline precond {

/// BoomerAMG on the whole assembled displacement block, for comparison: unknown approach, or nodal coarsening
/// with the rotations of the current configuration. Rigid bodies are left to block Jacobi.
class AssembledAmg final : public DisplacementPreconditioner {
 public:
  AssembledAmg(const CoupledSystem& system, bool nodal);
  int size() const override { return jacobi_.size(); }
  void apply(std::span<const double> x, std::span<double> y) const override;
  bool is_linear() const override { return true; }
  std::size_t bytes() const override { return jacobi_.bytes() + amg_->bytes(); }

 private:
  int nodal_;
  BlockJacobi jacobi_;
  std::unique_ptr<BoomerAmg> amg_;
};

/// MUMPS on the assembled displacement block: in full precision the best that any preconditioner of it can
/// do.
class ExactBlock final : public DisplacementPreconditioner {
 public:
  explicit ExactBlock(const CoupledSystem& system);
  /// With a solver that may know the matrix's pattern from an earlier linearisation, and gives up that one's
  /// factors unless `keep` lets them stay.
  ExactBlock(const CoupledSystem& system, std::shared_ptr<Mumps> mumps, const KeepFactors& keep = {});
  int size() const override { return size_; }
  void apply(std::span<const double> x, std::span<double> y) const override;
  bool is_linear() const override { return true; }
  std::string setup_error() const override { return setup_error_; }
  bool keeps_factors() const override { return keeps_factors_; }
  std::size_t bytes() const override { return bytes_; }

 private:
  int size_, nodal_;
  BodyBlocks bodies_;
  std::shared_ptr<Mumps> mumps_;
  std::string setup_error_;
  bool keeps_factors_ = false;
  std::size_t bytes_ = 0;
};

}  // namespace bulbus::inline precond
