#pragma once
#include "precond/coarse/rigid_coarse.hpp"
#include "precond/operators/displacement_preconditioner.hpp"
#include "precond/smoothers/line_jacobi.hpp"
#include "precond/smoothers/smoother.hpp"

namespace bulbus::inline precond {

/// What aggregation keeps from one linearisation to the next.
struct AggregationPlan {
  /// Collective.
  AggregationPlan(const CoupledSystem& system, const AggregationSettings& settings, Precision precision);
  std::shared_ptr<const Lines> lines;
  std::shared_ptr<RigidPlan> rigid;
};

/// Aggregation for meshes of any kind: a correction with the rigid motions of aggregates, on large meshes by
/// levels of aggregates of aggregates, then Chebyshev with
/// line Jacobi on the tangent as it is applied on the fly. The matrix is never formed. A fixed linear map;
/// not symmetric: GMRES does not ask for it, and smoothing twice as long afterwards takes fewer applications
/// than smoothing before, too.
class Aggregation final : public DisplacementPreconditioner {
 public:
  /// Collective.
  Aggregation(SharedSystem system, std::shared_ptr<const AggregationPlan> plan,
              const AggregationSettings& settings, Precision smoothing = Precision::single,
              const KeepFactors& keep = {});
  int size() const override { return static_cast<int>(correction_.size()); }
  void apply(std::span<const double> b, std::span<double> x) const override;
  bool is_linear() const override { return true; }
  double refresh(SharedSystem system) override { return smoother_->refresh(std::move(system)); }
  void release() override { smoother_->release(); }
  bool keeps_factors() const override { return coarse_.keeps_factors(); }
  bool could_be_factorised() const override { return coarse_.could_be_factorised(); }
  std::string setup_error() const override { return coarse_.setup_error(); }
  std::size_t bytes() const override;
  std::shared_ptr<const LineJacobi> lines() const override { return jacobi_; }

 private:
  std::shared_ptr<const LineJacobi> set_up(const CoupledSystem& system,
                                           const std::shared_ptr<const Lines>& lines, Precision precision,
                                           const KeepFactors& keep);

  RigidCoarse coarse_;
  std::shared_ptr<const LineJacobi> jacobi_;
  std::unique_ptr<Smoother> smoother_;
  mutable std::vector<double> correction_;
};

}  // namespace bulbus::inline precond
