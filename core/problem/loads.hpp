#pragma once
#include <functional>
#include <memory>
#include <string>

#include "core/element/bars.hpp"
#include "core/element/pressure_surface.hpp"
#include "core/problem/term.hpp"

namespace bulbus::inline problem {

/// A load that follows the step: value(s) is its size, s the part of the step done.
class Load : public Term {
 public:
  explicit Load(std::function<double(double)> value) : value_(std::move(value)) {}
  void set_progress(double s) override { now_ = value_(s); }
  void freeze() override {
    value_ = [end = value_(1)](double) { return end; };
  }
  /// From its size at the end of the last step to nothing at the end of this one.
  void fade() {
    value_ = [end = value_(1)](double s) { return end * (1 - s); };
  }
  double end() const { return value_(1); }

  std::string acts;  ///< how, but for its size: loads that act alike go over into one another

 protected:
  double now_ = 0;

 private:
  std::function<double(double)> value_;
};

/// Pressure against the body that follows its faces. The tangent is taken as it is, not symmetric: it would
/// be where the surface's rim is constrained.
class FollowerPressure final : public Load {
 public:
  FollowerPressure(PressureSurface surface, std::function<double(double)> value, bool symmetric)
      : Load(std::move(value)),
        surface_(std::make_shared<PressureSurface>(std::move(surface))),
        symmetric_(symmetric) {}
  void add_residual(const State& state, std::span<double> force,
                    std::span<double> reference_force) const override;
  std::shared_ptr<const TermTangent> tangent(const std::shared_ptr<const State>& state) const override;
  bool symmetric() const override { return symmetric_; }

 private:
  std::shared_ptr<const PressureSurface> surface_;
  bool symmetric_;
};

/// Nodal forces base + size · pattern: dead pressures and nodal forces.
class DeadLoad final : public Load {
 public:
  /// `base` (may be empty) and `pattern`: 3 numbers per local node, N; each rank gives its own share.
  DeadLoad(std::vector<double> base, std::vector<double> pattern, std::function<double(double)> value)
      : Load(std::move(value)), base_(std::move(base)), pattern_(std::move(pattern)) {}
  /// The forces at the end of the step.
  std::vector<double> at_end() const;
  void add_residual(const State&, std::span<double> force, std::span<double> reference_force) const override;

 private:
  std::vector<double> base_, pattern_;
};

/// Bars of one group.
class BarsTerm final : public Term {
 public:
  explicit BarsTerm(Bars bars) : bars_(std::make_shared<Bars>(std::move(bars))) {}
  const Bars& bars() const { return *bars_; }
  void add_residual(const State& state, std::span<double> force,
                    std::span<double> reference_force) const override {
    bars_->add_residual(state.x, force, reference_force);
  }
  std::shared_ptr<const TermTangent> tangent(const std::shared_ptr<const State>& state) const override;

 private:
  std::shared_ptr<const Bars> bars_;
};

/// reference_force[node] += |force of the node| for a nodal vector.
void add_reference_force(std::span<const double> force, std::span<double> reference_force);

/// ∫ N dA of the faces along a fixed direction (zero: against the reference normal out of the body), 3 per
/// local node.
std::vector<double> dead_pressure_pattern(std::span<const double> X, std::span<const Quad> faces,
                                          const Point& direction);

}  // namespace bulbus::inline problem
