#include "core/problem/loads.hpp"

#include <cmath>

#include "core/element/q1.hpp"

namespace bulbus::inline problem {
namespace {

struct FollowerTangent final : TermTangent {
  FollowerTangent(std::shared_ptr<const PressureSurface> s, double p, std::shared_ptr<const State> at)
      : surface(std::move(s)), pressure(p), state(std::move(at)) {}
  void add_action(std::span<const double> dx, std::span<double> force) const override {
    surface->add_stiffness(state->x, -pressure, dx, force);
  }
  void visit(const ContributionVisitor& visitor) const override {
    surface->visit(state->x, -pressure, visitor);
  }
  std::shared_ptr<const PressureSurface> surface;
  double pressure;  // MPa
  std::shared_ptr<const State> state;
};

struct BarsTangent final : TermTangent {
  BarsTangent(std::shared_ptr<const Bars> b, std::shared_ptr<const State> at)
      : bars(std::move(b)), state(std::move(at)) {}
  void add_action(std::span<const double> dx, std::span<double> force) const override {
    bars->add_stiffness(state->x, dx, force);
  }
  void visit(const ContributionVisitor& visitor) const override { bars->visit(state->x, visitor); }
  std::shared_ptr<const Bars> bars;
  std::shared_ptr<const State> state;
};

}  // namespace

void add_reference_force(std::span<const double> force, std::span<double> reference_force) {
  for (std::size_t n = 0; n < reference_force.size(); ++n)
    reference_force[n] += std::hypot(force[3 * n], force[3 * n + 1], force[3 * n + 2]);
}

void FollowerPressure::add_residual(const State& state, std::span<double> force,
                                    std::span<double> reference_force) const {
  if (now_ == 0) return;
  std::vector<double> own(force.size());
  surface_->add_gradient(state.x, -now_, own);  // the body is pushed by + p g
  for (std::size_t i = 0; i < own.size(); ++i) force[i] += own[i];
  add_reference_force(own, reference_force);
}

std::shared_ptr<const TermTangent> FollowerPressure::tangent(
    const std::shared_ptr<const State>& state) const {
  return now_ == 0 ? nullptr : std::make_shared<FollowerTangent>(surface_, now_, state);
}

std::shared_ptr<const TermTangent> BarsTerm::tangent(const std::shared_ptr<const State>& state) const {
  return std::make_shared<BarsTangent>(bars_, state);
}

void DeadLoad::add_residual(const State&, std::span<double> force, std::span<double> reference_force) const {
  std::vector<double> own(pattern_);
  for (std::size_t i = 0; i < own.size(); ++i)
    force[i] += own[i] = -(base_.empty() ? 0 : base_[i]) - now_ * own[i];
  add_reference_force(own, reference_force);
}

std::vector<double> DeadLoad::at_end() const {
  std::vector<double> f(pattern_);
  for (std::size_t i = 0; i < f.size(); ++i) f[i] = (base_.empty() ? 0 : base_[i]) + end() * f[i];
  return f;
}

std::vector<double> dead_pressure_pattern(std::span<const double> X, std::span<const Quad> faces,
                                          const Point& direction) {
  std::vector<double> pattern(X.size());
  const double length = norm(direction);
  if (length == 0) {
    PressureSurface(faces).add_gradient(X, 1, pattern);
    return pattern;
  }
  constexpr double s[4] = {-1, 1, 1, -1}, t[4] = {-1, -1, 1, 1}, g = gauss_near - gauss_far;
  for (const Quad& q : faces)
    for (int p = 0; p < 4; ++p) {
      Vec3<double> a{}, b{};
      double N[4];
      for (int n = 0; n < 4; ++n) {
        const double along = 1 + g * s[p] * s[n], across = 1 + g * t[p] * t[n];
        N[n] = along * across / 4;
        for (int c = 0; c < 3; ++c) {
          a[c] += s[n] * across / 4 * X[3 * q[n] + c];
          b[c] += t[n] * along / 4 * X[3 * q[n] + c];
        }
      }
      const double area = norm(cross(a, b));
      for (int n = 0; n < 4; ++n)
        for (int c = 0; c < 3; ++c) pattern[3 * q[n] + c] += N[n] * area * direction[c] / length;
    }
  return pattern;
}

}  // namespace bulbus::inline problem
