#include <cmath>

#include "core/solve/direct/factor_preconditioner.hpp"
#include "core/solve/direct/system_factors.hpp"

namespace bulbus::inline solve {
namespace {

class DirectSolver final : public LinearSolver {
 public:
  DirectSolver(const LinearSettings& settings, Profiler& profiler)
      : factors_(settings, profiler), profiler_(profiler) {}

  Preparation prepare(SharedSystem system) override {
    factor_ = factors_.factorise(system);
    symmetric_ = system->problem().symmetric();
    Preparation prepared{.ok = factor_.ok, .factor = factor_, .negative_pivots = negative_pivots()};
    if (!factor_.ok) prepared.reason = factors_.name() + ": " + factor_.reason;
    return prepared;
  }

  LinearReport solve(const CoupledOperator& A, std::vector<double> b, std::span<double> x, double) override {
    const auto scope = profiler_.clock.measure("linear solve");
    LinearReport report{.negative_pivots = negative_pivots(), .factor = factor_};
    report.ok = factors_.solve(b, x);
    if (!report.ok) return report.reason = factors_.name() + " could not solve", report;
    std::vector<double> r(b.size());
    A.apply(x, r);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
    const double scale = scaled_norm(A.system(), b);
    report.reduction = scale > 0 ? scaled_norm(A.system(), r) / scale : 0;
    if (!std::isfinite(report.reduction))
      report.ok = false, report.reason = factors_.name() + ": the solution is not finite";
    if (unsolvable(factor_, report.reduction))
      report.ok = false, report.reason = factors_.name() + ": the matrix is singular";
    return report;
  }

 private:
  int negative_pivots() const { return symmetric_ ? factor_.nonpositive() : -1; }

  SystemFactors factors_;
  Profiler& profiler_;
  FactorReport factor_;
  bool symmetric_ = true;
};

}  // namespace

std::unique_ptr<LinearSolver> make_direct_solver(const LinearSettings& settings, Profiler& profiler) {
  if (settings.refinement == Refinement::gmres)
    return make_krylov_solver(settings, make_factor_preconditioners(settings, profiler), profiler);
  return std::make_unique<DirectSolver>(settings, profiler);
}

}  // namespace bulbus::inline solve
