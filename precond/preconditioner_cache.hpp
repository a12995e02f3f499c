#pragma once
#include <memory>
#include <vector>

#include "core/solve/linear_solver.hpp"
#include "precond/block_triangular.hpp"
#include "precond/operators/displacement.hpp"
#include "precond/reuse_policy.hpp"

namespace bulbus::inline precond {

/// Makes the preconditioner of the coupled system that the settings name, of one linearisation after the
/// other, and owns all that outlives a linearisation, together with the preconditioners that use it.
class PreconditionerCache final : public PreconditionerFactory {
 public:
  PreconditionerCache(const LinearSettings& settings, Profiler& profiler);
  std::unique_ptr<CoupledPreconditioner> make(SharedSystem system) override;
  void release() override;
  void record(double iterations_per_digit) override { history_.add(iterations_per_digit); }
  bool can_improve() const override;
  void improve() override;
  void forget() override { history_ = {}; }
  /// What the last preconditioner has taken over.
  const Reuse& reused() const { return reused_; }

 private:
  Reuse refreshed(const SharedSystem& system);

  LinearSettings settings_;
  Profiler& profiler_;
  DisplacementFactory factory_;
  SolveHistory history_;
  Reuse reused_;
  std::shared_ptr<DisplacementPreconditioner> displacement_;
  std::shared_ptr<SchurCorrections> corrections_;
  std::shared_ptr<LiquidColumns> columns_;
};

}  // namespace bulbus::inline precond
