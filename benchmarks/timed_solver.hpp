#pragma once
#include "benchmarks/common.hpp"
#include "benchmarks/variants.hpp"
#include "core/solve/linear_solver.hpp"

namespace bulbus::bench {

/// A linear solver that keeps processor seconds, iterations and reached reduction of every set-up (or
/// factorisation) and solution, and the wall-clock seconds of both.
class TimedSolver final : public LinearSolver {
 public:
  explicit TimedSolver(std::unique_ptr<LinearSolver> inner) : inner_(std::move(inner)) {}
  Preparation prepare(SharedSystem system) override {
    const double start = cpu_seconds(), wall = Clock::now();
    const Preparation prepared = inner_->prepare(std::move(system));
    setup.push_back(cpu_seconds() - start);
    wall_setup_ = Clock::now() - wall;
    if (prepared.factor) {
      factor = prepared.factor;
      analysis = std::max(analysis, factor->seconds_analysis);
      factorisation.push_back(factor->seconds_factorisation);
    }
    return prepared;
  }
  LinearReport solve(const CoupledOperator& A, std::vector<double> b, std::span<double> x,
                     double tolerance) override {
    const double start = cpu_seconds(), begin = Clock::now();
    const LinearReport report = inner_->solve(A, std::move(b), x, tolerance);
    solution.push_back(cpu_seconds() - start);
    wall.push_back(wall_setup_ + Clock::now() - begin);
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
  std::vector<double> setup, solution, reductions, wall, factorisation;
  std::vector<int> iterations;
  std::optional<FactorReport> factor;  ///< the last
  double analysis = 0;                 ///< the longest: later matrices of the same pattern need none

 private:
  std::unique_ptr<LinearSolver> inner_;
  double wall_setup_ = 0;
};

}  // namespace bulbus::bench
