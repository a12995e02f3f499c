#include "core/element/bars.hpp"

namespace bulbus::inline element {
namespace {

// The (up to eight) nodes of a bar with the factor of each in d = x2 − x1.
struct Ends {
  std::array<int, 8> nodes;
  std::array<double, 8> weights;
  int count = 0;
};

Ends ends(const Bar& bar) {
  Ends e;
  for (const auto& [point, sign] : {std::pair{&bar.a, -1.0}, std::pair{&bar.b, 1.0}})
    for (int i = 0; i < 4; ++i)
      if (point->weights[i] != 0) {
        e.nodes[e.count] = point->nodes[i];
        e.weights[e.count++] = sign * point->weights[i];
      }
  return e;
}

void add(const Ends& e, const Vec3<double>& f, std::span<double> out) {
  for (int i = 0; i < e.count; ++i)
    for (int c = 0; c < 3; ++c) out[3 * e.nodes[i] + c] += e.weights[i] * f[c];
}

Vec3<double> difference(const Ends& e, std::span<const double> v) {
  Vec3<double> d{0, 0, 0};
  for (int i = 0; i < e.count; ++i)
    for (int c = 0; c < 3; ++c) d[c] += e.weights[i] * v[3 * e.nodes[i] + c];
  return d;
}

}  // namespace

Vec3<double> place(const EmbeddedPoint& p, std::span<const double> x) {
  Vec3<double> r{0, 0, 0};
  for (int i = 0; i < 4; ++i)
    if (p.weights[i] != 0)
      for (int c = 0; c < 3; ++c) r[c] += p.weights[i] * x[3 * p.nodes[i] + c];
  return r;
}

Bars::Bars(std::span<const double> X, std::span<const Bar> bars, double E, double area, bool tension_only)
    : bars_(bars.begin(), bars.end()), E_(E), area_(area), tension_only_(tension_only) {
  for (const Bar& b : bars_) length_.push_back(norm(difference(ends(b), X)));
}

Bars::Pull Bars::pull(std::span<const double> x, std::size_t i) const {
  const double L = length_[i], A = area_ * bars_[i].share;
  const Vec3<double> d = difference(ends(bars_[i]), x);
  const double e = (dot(d, d) - L * L) / (2 * L * L);
  // An unstrained bar counts as stretched, up to round-off, so that the first tangent of a run has it.
  if (tension_only_ && e < -1e-10) return {d, 0, 0};
  return {d, A * E_ / (L * L * L), A * E_ * e / L};
}

void Bars::add_residual(std::span<const double> x, std::span<double> force,
                        std::span<double> reference_force) const {
  for (std::size_t i = 0; i < bars_.size(); ++i) {
    const Pull p = pull(x, i);
    const Ends e = ends(bars_[i]);
    add(e, {p.tension * p.d[0], p.tension * p.d[1], p.tension * p.d[2]}, force);
    if (!reference_force.empty())
      for (int k = 0; k < e.count; ++k)
        reference_force[e.nodes[k]] += std::abs(e.weights[k] * p.tension) * norm(p.d);
  }
}

void Bars::add_stiffness(std::span<const double> x, std::span<const double> dx, std::span<double> out) const {
  for (std::size_t i = 0; i < bars_.size(); ++i) {
    const Pull p = pull(x, i);
    const Ends e = ends(bars_[i]);
    const Vec3<double> dd = difference(e, dx);
    const double along = p.stretch_stiffness * dot(p.d, dd);
    add(e,
        {along * p.d[0] + p.tension * dd[0], along * p.d[1] + p.tension * dd[1],
         along * p.d[2] + p.tension * dd[2]},
        out);
  }
}

void Bars::visit(std::span<const double> x, const ContributionVisitor& visitor) const {
  std::vector<double> K;
  for (std::size_t i = 0; i < bars_.size(); ++i) {
    const Pull p = pull(x, i);
    const Ends e = ends(bars_[i]);
    const int n = 3 * e.count;
    K.assign(n * n, 0);
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b)
        K[n * a + b] = e.weights[a / 3] * e.weights[b / 3] *
                       (p.stretch_stiffness * p.d[a % 3] * p.d[b % 3] + (a % 3 == b % 3 ? p.tension : 0));
    visitor(std::span(e.nodes).first(e.count), K);
  }
}

std::vector<double> Bars::forces(std::span<const double> x) const {
  std::vector<double> f;
  for (std::size_t i = 0; i < bars_.size(); ++i) {
    const Pull p = pull(x, i);
    f.push_back(p.tension * norm(p.d) / bars_[i].share);
  }
  return f;
}

}  // namespace bulbus::inline element
