#pragma once
#include "precond/coarse/rigid_coarse.hpp"
#include "precond/smoothers/line_jacobi.hpp"
#include "precond/smoothers/smoother.hpp"

namespace bulbus {

/// What aggregation keeps from one linearisation to the next.
struct AggregationPlan {
  /// Collective.
  AggregationPlan(const CoupledSystem& system, int nodes, Precision precision);
  Lines lines;
  RigidPlan rigid;
};

/// Two grids for meshes of any kind: a correction with the rigid motions of aggregates, then Chebyshev with
/// line Jacobi on the tangent as it is applied on the fly. The matrix is never formed. A fixed linear map;
/// not symmetric: GMRES does not ask for it, and smoothing twice as long afterwards takes fewer applications
/// than smoothing before, too.
class Aggregation final : public Preconditioner {
 public:
  /// Collective.
  Aggregation(const CoupledSystem& system, AggregationPlan& plan, const AggregationSettings& settings,
              Precision smoothing = Precision::single);
  int size() const override { return static_cast<int>(correction_.size()); }
  void apply(std::span<const double> b, std::span<double> x) const override;
  bool fixed() const override { return true; }
  bool follow() override { return smoother_->follow(); }
  std::string fault() const override { return coarse_.fault(); }
  std::size_t bytes() const override;
  const LineJacobi& lines() const { return jacobi_; }

 private:
  LineJacobi set_up(const CoupledSystem& system, const Lines& lines, Precision precision);

  RigidCoarse coarse_;
  LineJacobi jacobi_;
  std::unique_ptr<Smoother> smoother_;
  mutable std::vector<double> correction_;
};

}  // namespace bulbus
