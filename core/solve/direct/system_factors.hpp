#pragma once
#include <memory>

#include "core/solve/direct/make_factorisation.hpp"
#include "core/solve/linear_solver.hpp"

namespace bulbus::inline solve {

/// Factors of one coupled system after the other, by the direct solver of the settings. All members are
/// collective.
class SystemFactors {
 public:
  SystemFactors(const LinearSettings& settings, Profiler& profiler)
      : settings_(settings), profiler_(profiler) {}
  /// Without augmentation by ω. What would not fit into the settings'
  /// memory limit is refused.
  FactorReport factorise(SharedSystem system);
  bool solve(std::span<const double> b, std::span<double> x) { return library_ && library_->solve(b, x); }
  /// Of the library.
  std::string name() const { return name_of(settings_.direct); }

 private:
  FactorReport refused(const CoupledSystem& system, double limit_mb, bool triangle) const;

  LinearSettings settings_;
  Profiler& profiler_;
  std::unique_ptr<Factorisation> library_;
};

}  // namespace bulbus::inline solve
