#include "core/solve/direct/factor_preconditioner.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/solve/direct/system_factors.hpp"

namespace bulbus::inline solve {
namespace {

class FactorPreconditioner final : public CoupledPreconditioner {
 public:
  FactorPreconditioner(const SharedSystem& system, SystemFactors& factors)
      : factors_(factors), size_(system->size()), report_(factors.factorise(system)) {}
  int size() const override { return size_; }
  bool is_linear() const override { return true; }
  void apply(std::span<const double> x, std::span<double> y) const override {
    if (!factors_.solve(x, y)) throw std::runtime_error(factors_.name() + " could not solve");
  }
  std::string setup_error() const override {
    return report_.ok ? "" : factors_.name() + ": " + report_.reason;
  }
  const LiquidAugmentation& augmentation() const override { return none_; }
  bool has_deferred_component() const override { return false; }
  void enable_deferred_component(double) override {}
  std::array<double, 2> displacement_spectrum() const override {
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  }
  std::optional<FactorReport> factor() const override { return report_; }

 private:
  SystemFactors& factors_;
  int size_;
  FactorReport report_;
  LiquidAugmentation none_;
};

// Every linearisation has its own factors; the analysis stays.
class FactorPreconditioners final : public PreconditionerFactory {
 public:
  FactorPreconditioners(const LinearSettings& settings, Profiler& profiler) : factors_(settings, profiler) {}
  std::unique_ptr<CoupledPreconditioner> make(SharedSystem system) override {
    return std::make_unique<FactorPreconditioner>(system, factors_);
  }
  void release() override {}
  void record(double) override {}
  bool can_improve() const override { return false; }
  void improve() override {}
  void forget() override {}

 private:
  SystemFactors factors_;
};

}  // namespace

std::unique_ptr<PreconditionerFactory> make_factor_preconditioners(const LinearSettings& settings,
                                                                   Profiler& profiler) {
  return std::make_unique<FactorPreconditioners>(settings, profiler);
}

}  // namespace bulbus::inline solve
