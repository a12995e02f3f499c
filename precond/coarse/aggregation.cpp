#include "precond/coarse/aggregation.hpp"

#include "core/base/memory.hpp"
#include "core/solve/reduced.hpp"

namespace bulbus::inline precond {

AggregationPlan::AggregationPlan(const CoupledSystem& system, const AggregationSettings& settings,
                                 Precision precision)
    : lines(std::make_shared<Lines>(find_lines(system.problem()))),
      rigid(std::make_shared<RigidPlan>(system, settings.nodes, precision, settings.factorised)) {}

Aggregation::Aggregation(SharedSystem system, std::shared_ptr<const AggregationPlan> plan,
                         const AggregationSettings& settings, Precision smoothing, const KeepFactors& keep)
    : coarse_(*system, plan->rigid),
      jacobi_(set_up(*system, plan->lines, smoothing, keep)),
      smoother_(make_smoother(system, jacobi_, settings, smoothing)),
      correction_(system->layout().primal()) {}

// One sweep over everything that contributes, for lines and coarse matrix.
std::shared_ptr<const LineJacobi> Aggregation::set_up(const CoupledSystem& system,
                                                      const std::shared_ptr<const Lines>& lines,
                                                      Precision precision, const KeepFactors& keep) {
  LineBlocks blocks(system, *lines);
  for_each_condensed_matrix(system, matrices_of(precision),
                            [&](std::span<const int> dofs, std::span<const double> K) {
                              blocks.add(dofs, K);
                              coarse_.add(dofs, K);
                            });
  coarse_.factorise(system, keep);
  blocks.complete();
  return std::make_shared<LineJacobi>(system, lines, blocks);
}

void Aggregation::apply(std::span<const double> b, std::span<double> x) const {
  coarse_.apply(b, correction_);
  smoother_->improve(b, correction_, x);
}

std::size_t Aggregation::bytes() const {
  return coarse_.bytes() + jacobi_->bytes() + smoother_->bytes() + bytes_of(correction_);
}

}  // namespace bulbus::inline precond
