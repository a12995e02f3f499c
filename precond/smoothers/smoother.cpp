#include "precond/smoothers/smoother.hpp"

#include <algorithm>
#include <utility>

#include "core/base/memory.hpp"
#include "precond/operators/displacement.hpp"
#include "precond/operators/single_block.hpp"
#include "precond/smoothers/chebyshev.hpp"

namespace bulbus::inline precond {
namespace {

class FullSmoother final : public Smoother {
 public:
  FullSmoother(const SharedSystem& system, std::shared_ptr<const LineJacobi> lines, const SmootherSettings& s,
               double largest)
      : A_(std::make_shared<DisplacementBlock>(system)),
        S_(A_, std::move(lines), s.degree, s.smoothing_range, system->problem().comm(), largest),
        rest_(A_->size()),
        correction_(A_->size()) {}

  void before(std::span<const double> b, std::span<double> x, std::span<double> r) const override {
    S_.apply(b, x);
    A_->apply(x, r);
    for (std::size_t i = 0; i < r.size(); ++i) rest_[i] = r[i] = b[i] - r[i];
  }
  void after(std::span<const double> e, std::span<double> x) const override {
    A_->apply(e, correction_);
    for (std::size_t i = 0; i < rest_.size(); ++i) rest_[i] -= correction_[i];
    S_.apply(rest_, correction_);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += e[i] + correction_[i];
  }
  void improve(std::span<const double> b, std::span<const double> e, std::span<double> x) const override {
    std::ranges::copy(b, rest_.begin());
    std::ranges::fill(x, 0);
    after(e, x);
  }
  double refresh(SharedSystem system) override {
    A_->refresh(std::move(system));
    return S_.refresh();
  }
  void release() override { A_->release(); }
  double largest_eigenvalue() const override { return S_.largest_eigenvalue(); }
  std::size_t bytes() const override { return S_.bytes() + bytes_of(rest_) + bytes_of(correction_); }

 private:
  std::shared_ptr<DisplacementBlock> A_;
  Chebyshev S_;
  mutable std::vector<double> rest_, correction_;
};

// Held directions are taken out first and solved for as what they are, identity rows.
class SingleSmoother final : public Smoother {
 public:
  SingleSmoother(const SharedSystem& system, std::shared_ptr<const LineJacobi> lines,
                 const SmootherSettings& s, double largest)
      : A_(std::make_shared<SingleBlock>(system)),
        lines_(std::move(lines)),
        degree_(s.degree),
        spectrum_(A_, lines_, s.smoothing_range, system->problem().comm(), largest),
        r_(*system),
        x_(*system) {}

  void before(std::span<const double> b, std::span<double> x, std::span<double> r) const override {
    load(b);
    smooth();
    A_->apply();
    subtract();
    std::ranges::fill(x, 0);
    add(x);
    dofs().add_constrained(b, 1 / A_->system().constrained_diagonal(), x);
    for (std::size_t n = 0; n < owned(); ++n)
      for (int c = 0; c < 3; ++c) r[3 * n + c] = r_.nodal[n][c];
    std::ranges::copy(r_.bodies, r.begin() + 3 * owned());
  }
  void after(std::span<const double> e, std::span<double> x) const override {
    A_->apply_to(e);
    subtract();
    smooth();
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += e[i];
    add(x);
  }
  void improve(std::span<const double> b, std::span<const double> e, std::span<double> x) const override {
    load(b);
    std::ranges::fill(x, 0);
    after(e, x);
    dofs().add_constrained(b, 1 / A_->system().constrained_diagonal(), x);
  }
  double refresh(SharedSystem system) override {
    A_->refresh(std::move(system));
    return spectrum_.refresh();
  }
  void release() override { A_->release(); }
  double largest_eigenvalue() const override { return spectrum_.largest_eigenvalue(); }
  std::size_t bytes() const override { return A_->bytes() + r_.bytes() + x_.bytes(); }

 private:
  std::size_t owned() const { return A_->system().problem().mesh().owned; }
  const DofMap& dofs() const { return A_->system().problem().dofs(); }

  void load(std::span<const double> b) const {
    for (std::size_t n = 0; n < owned(); ++n) r_.nodal[n] = rounded(&b[3 * n]);
    std::copy(b.begin() + 3 * owned(), b.end(), r_.bodies.begin());
    dofs().project(r_.nodal);
  }

  // r −= z, and no forces are left
  void subtract() const {
    auto& z = A_->z();
    for (std::size_t n = 0; n < owned(); ++n) {
      r_.nodal[n] -= z.nodal[n];
      z.nodal[n] = NodeSingle{};
    }
    subtract_bodies();
  }
  void subtract_bodies() const {
    for (std::size_t i = 0; i < r_.bodies.size(); ++i) r_.bodies[i] -= std::exchange(A_->z().bodies[i], 0);
  }

  // x = S r; r lacks what the last step of d changes
  void smooth() const {
    NodalSingle &d = A_->d(), &z = A_->z();
    std::ranges::fill(d.nodal, NodeSingle{});
    std::ranges::fill(d.bodies, 0);
    std::ranges::fill(x_.nodal, NodeSingle{});
    std::ranges::fill(x_.bodies, 0);
    auto steps = spectrum_.steps();
    std::vector<double> change(r_.bodies.size());
    for (int k = 0; k < degree_; ++k) {
      if (k > 0) A_->apply();
      const auto [keep, add] = steps.next();
      lines_->step(static_cast<float>(keep), static_cast<float>(add), r_.nodal, z.nodal, d.nodal, x_.nodal);
      subtract_bodies();
      lines_->bodies().apply(r_.bodies, change);
      for (std::size_t i = 0; i < change.size(); ++i)
        x_.bodies[i] += d.bodies[i] = keep * d.bodies[i] + add * change[i];
    }
  }

  // What smooth() has found.
  void add(std::span<double> x) const {
    dofs().project(x_.nodal);
    for (std::size_t n = 0; n < owned(); ++n)
      for (int c = 0; c < 3; ++c) x[3 * n + c] += x_.nodal[n][c];
    for (std::size_t i = 0; i < x_.bodies.size(); ++i) x[3 * owned() + i] += x_.bodies[i];
  }

  std::shared_ptr<SingleBlock> A_;
  std::shared_ptr<const LineJacobi> lines_;
  int degree_;
  DampedSpectrum spectrum_;
  mutable NodalSingle r_, x_;
};

}  // namespace

std::unique_ptr<Smoother> make_smoother(SharedSystem system, std::shared_ptr<const LineJacobi> lines,
                                        const SmootherSettings& settings, Precision precision,
                                        double largest_eigenvalue) {
  if (precision == Precision::single)
    return std::make_unique<SingleSmoother>(system, std::move(lines), settings, largest_eigenvalue);
  return std::make_unique<FullSmoother>(system, std::move(lines), settings, largest_eigenvalue);
}

}  // namespace bulbus::inline precond
