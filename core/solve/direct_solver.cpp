#include <fmt/format.h>

#include <cmath>

#include "core/solve/assemble.hpp"
#include "core/solve/linear_solver.hpp"
#include "core/solve/mumps.hpp"

namespace bulbus {
namespace {

// Bytes of an entry of the matrix until MUMPS has analysed it, measured on 2e8 of them: the triplet, MUMPS's
// copy, both directions of its graph and the ordering's.
constexpr double bytes_per_entry = 50;

double scaled_norm(const CoupledSystem& system, std::span<const double> v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += std::pow(system.scaling()[i] * v[i], 2);
  return std::sqrt(system.problem().comm().sum(sum));
}

class DirectSolver final : public LinearSolver {
 public:
  DirectSolver(const LinearSettings& settings, Profiler& profiler)
      : limit_mb_(settings.allowed_mb()), profiler_(profiler) {}

  LinearReport prepare(CoupledSystem& system) override {
    const auto scope = profiler_.clock.measure("factorisation");
    factor_ = factorised(system);
    profiler_.memory.set("factor", static_cast<std::size_t>(factor_.memory_max_mb * 1e6));
    LinearReport report = so_far();
    report.ok = factor_.ok;
    if (!factor_.ok) report.reason = "MUMPS: " + factor_.reason;
    return report;
  }

  LinearReport solve(const CoupledSystem& system, std::vector<double> b, std::span<double> x,
                     double) override {
    const auto scope = profiler_.clock.measure("linear solve");
    LinearReport report = so_far();
    report.ok = mumps_->solve(b, x);
    if (!report.ok) return report.reason = "MUMPS could not solve", report;
    std::vector<double> r(b.size());
    system.apply(x, r);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
    const double scale = scaled_norm(system, b);
    report.reduction = scale > 0 ? scaled_norm(system, r) / scale : 0;
    return report;
  }

 private:
  FactorReport factorised(const CoupledSystem& system) {
    symmetric_ = system.problem().symmetric();
    const Triangle part = symmetric_ ? Triangle::upper : Triangle::both;
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
          system.problem().comm(), MumpsOptions{.memory_limit_mb = system.problem().comm().min(limit_mb_)});
    return mumps_->factorise(assemble(system, true, part), global_size(system), symmetric_);
  }
  LinearReport so_far() const {
    return {.negative_pivots = symmetric_ ? factor_.negative_pivots : -1, .factor = factor_};
  }

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

}  // namespace bulbus
