#include <cmath>

#include "core/solve/assemble.hpp"
#include "core/solve/linear_solver.hpp"
#include "core/solve/mumps.hpp"

namespace bulbus {
namespace {

double scaled_norm(const CoupledSystem& system, std::span<const double> v) {
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) sum += std::pow(system.scaling()[i] * v[i], 2);
  return std::sqrt(system.problem().comm().sum(sum));
}

class DirectSolver final : public LinearSolver {
 public:
  explicit DirectSolver(Meters& meters) : meters_(meters) {}

  LinearReport prepare(CoupledSystem& system) override {
    const auto scope = meters_.clock.measure("factorisation");
    if (!mumps_) mumps_ = std::make_unique<Mumps>(system.problem().comm());
    const bool symmetric = system.problem().symmetric();
    const FactorReport f = mumps_->factorise(assemble(system, true, symmetric ? Triangle::upper : Triangle::both), global_size(system), symmetric);
    meters_.memory.set("factor", static_cast<std::size_t>(f.memory_max_mb * 1e6));
    pivots_ = symmetric ? f.negative_pivots : -1;
    return {.ok = f.ok, .reason = f.ok ? "" : "MUMPS: " + f.reason, .negative_pivots = pivots_};
  }

  LinearReport solve(const CoupledSystem& system, std::span<const double> b, std::span<double> x, double) override {
    const auto scope = meters_.clock.measure("linear solve");
    if (!mumps_->solve(b, x)) return {.reason = "MUMPS could not solve"};
    std::vector<double> r(b.size());
    system.apply(x, r);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = b[i] - r[i];
    const double scale = scaled_norm(system, b);
    return {.ok = true, .reduction = scale > 0 ? scaled_norm(system, r) / scale : 0, .negative_pivots = pivots_};
  }

 private:
  Meters& meters_;
  std::unique_ptr<Mumps> mumps_;
  int pivots_ = -1;
};

}  // namespace

std::unique_ptr<LinearSolver> make_direct_solver(const LinearSettings&, Meters& meters) {
  return std::make_unique<DirectSolver>(meters);
}

}  // namespace bulbus
