#include <fmt/format.h>

#include <cmath>

#include "core/solve/assemble.hpp"
#include "core/solve/linear_solver.hpp"
#include "core/solve/mumps.hpp"

namespace bulbus::inline solve {
namespace {

// Bytes of an entry of the matrix until MUMPS has analysed it, measured on 2e8 of them: the triplet, MUMPS's
// copy, both directions of its graph and the ordering's.
constexpr double bytes_per_entry = 50;

class DirectSolver final : public LinearSolver {
 public:
  DirectSolver(const LinearSettings& settings, Profiler& profiler)
      : limit_mb_(settings.allowed_mb()), profiler_(profiler) {}

  Preparation prepare(const CoupledSystem& system) override {
    const auto scope = profiler_.clock.measure("factorisation");
    factor_ = factorised(system);
    profiler_.memory.set("factor", static_cast<std::size_t>(factor_.memory_max_mb * 1e6));
    Preparation prepared{.ok = factor_.ok, .factor = factor_, .negative_pivots = negative_pivots()};
    if (!factor_.ok) prepared.reason = "MUMPS: " + factor_.reason;
    return prepared;
  }

  LinearReport solve(const CoupledOperator& A, std::vector<double> b, std::span<double> x, double) override {
    const auto scope = profiler_.clock.measure("linear solve");
    LinearReport report{.negative_pivots = negative_pivots(), .factor = factor_};
    report.ok = mumps_->solve(b, x);
    if (!report.ok) return report.reason = "MUMPS could not solve", report;
    std::vector<double> r(b.size());
    A.apply(x, r);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
    const double scale = scaled_norm(A.system(), b);
    report.reduction = scale > 0 ? scaled_norm(A.system(), r) / scale : 0;
    if (unsolvable(factor_, report.reduction))
      report.ok = false, report.reason = "MUMPS: the matrix is singular";
    return report;
  }

 private:
  FactorReport factorised(const CoupledSystem& system) {
    symmetric_ = system.problem().symmetric();
    const Triangles part = symmetric_ ? Triangles::upper : Triangles::both;
    const double entries = static_cast<double>(liquid_entries(system, part)),
                 dense_mb = 1e-6 * bytes_per_entry * entries;
    if (dense_mb > limit_mb_)
      return {.reason = fmt::format(
                  "{:.3g} entries of the liquids need about {:.0f} MB, more than the {:.0f} MB allowed",
                  entries, dense_mb, limit_mb_),
              .too_large = true,
              .matrix_entries = entries,
              .estimated_mb = dense_mb};
    if (!mumps_)
      mumps_ = std::make_unique<Mumps>(
          system.problem().comm(),
          MumpsOptions{.null_pivots = true, .memory_limit_mb = system.problem().comm().min(limit_mb_)});
    return mumps_->factorise(assemble(CoupledOperator(system), part), global_size(system), symmetric_);
  }
  int negative_pivots() const { return symmetric_ ? factor_.nonpositive() : -1; }

  double limit_mb_;
  Profiler& profiler_;
  std::unique_ptr<Mumps> mumps_;
  FactorReport factor_;
  bool symmetric_ = true;
};

}  // namespace

std::unique_ptr<LinearSolver> make_direct_solver(const LinearSettings& settings, Profiler& profiler) {
  return std::make_unique<DirectSolver>(settings, profiler);
}

}  // namespace bulbus::inline solve
