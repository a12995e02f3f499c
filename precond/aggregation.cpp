#include "precond/aggregation.hpp"

#include "core/base/memory.hpp"
#include "core/solve/reduced.hpp"
#include "precond/correct.hpp"

namespace bulbus {

AggregationPlan::AggregationPlan(const CoupledSystem& system, int nodes, Precision precision)
    : lines(find_lines(system.problem())), rigid(system, nodes, precision) {}

Aggregation::Aggregation(const CoupledSystem& system, AggregationPlan& plan, const AggregationSettings& settings, Precision smoothing)
    : block_(system, smoothing),
      coarse_(system, plan.rigid),
      jacobi_(set_up(system, plan.lines)),
      smoother_(block_, jacobi_, settings.degree, settings.smoothed_part, system.problem().comm()),
      residual_(block_.size()),
      correction_(block_.size()) {}

// One sweep over everything that contributes, for lines and coarse matrix.
LineJacobi Aggregation::set_up(const CoupledSystem& system, const Lines& lines) {
  LineCouplings couplings(system, lines);
  visit_reduced(system.problem(), system.state(), true, [&](std::span<const int> dofs, std::span<const double> K) {
    couplings.add(dofs, K);
    coarse_.add(dofs, K);
  });
  coarse_.factorise();
  return LineJacobi(system, lines, couplings.sum());
}

void Aggregation::apply(std::span<const double> b, std::span<double> x) const {
  coarse_.apply(b, x);
  correct(block_, smoother_, b, x, residual_, correction_);
}

std::size_t Aggregation::bytes() const {
  return coarse_.bytes() + jacobi_.bytes() + smoother_.bytes() + bytes_of(residual_) + bytes_of(correction_);
}

}  // namespace bulbus
