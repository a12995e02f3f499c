#pragma once
#include "benchmarks/common.hpp"
#include "core/solve/linear_solver.hpp"

namespace bulbus::bench {

/// Default settings of "direct" or "iterative", with a limit of the factors' memory (0: the machine's).
inline SolverSettings settings_of(const std::string& method, double memory_mb) {
  SolverSettings s;
  s.linear.method = from_word<Method>(method);
  if (memory_mb > 0) s.linear.memory_limit = memory_mb;
  if (method == "direct") s.linear.gamma = 0;  // the direct solver takes the system as it is
  return s;
}

/// A linear solver that keeps processor seconds, iterations and reached reduction of every set-up (or
/// factorisation) and solution.
class TimedSolver final : public LinearSolver {
 public:
  explicit TimedSolver(std::unique_ptr<LinearSolver> inner) : inner_(std::move(inner)) {}
  Preparation prepare(SharedSystem system) override {
    const double start = cpu_seconds();
    const Preparation prepared = inner_->prepare(std::move(system));
    setup.push_back(cpu_seconds() - start);
    if (prepared.factor) factor = prepared.factor;
    return prepared;
  }
  LinearReport solve(const CoupledOperator& A, std::vector<double> b, std::span<double> x,
                     double tolerance) override {
    const double start = cpu_seconds();
    const LinearReport report = inner_->solve(A, std::move(b), x, tolerance);
    solution.push_back(cpu_seconds() - start);
    iterations.push_back(report.iterations);
    reductions.push_back(report.reduction);
    return report;
  }
  void release() override { inner_->release(); }
  void forget() override { inner_->forget(); }
  void increment_begins() override { inner_->increment_begins(); }
  void watch(SolveWatcher watcher) override { inner_->watch(std::move(watcher)); }
  bool counts_pivots(const Problem& problem) override { return inner_->counts_pivots(problem); }
  int negative_pivots(const CoupledSystem& system) override { return inner_->negative_pivots(system); }
  std::vector<double> setup, solution, reductions;
  std::vector<int> iterations;
  std::optional<FactorReport> factor;  ///< the last

 private:
  std::unique_ptr<LinearSolver> inner_;
};

}  // namespace bulbus::bench
