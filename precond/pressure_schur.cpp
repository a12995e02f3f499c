#include "precond/pressure_schur.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/base/memory.hpp"

namespace bulbus {
namespace {

// (1 + γ) μ_e/V_e; zero of rigid hexahedra, which have no Schur complement.
class Diagonal final : public Preconditioner {
 public:
  explicit Diagonal(const CoupledSystem& system) : values_(system.inverse_pressure_schur()) {
    for (int e : system.problem().solid().rigid_hexes()) values_[e] = 0;
  }
  int size() const override { return static_cast<int>(values_.size()); }
  void apply(std::span<const double> r, std::span<double> z) const override { std::ranges::transform(values_, r, z.begin(), std::multiplies{}); }
  bool fixed() const override { return true; }
  std::size_t bytes() const override { return bytes_of(values_); }

 private:
  std::vector<double> values_;
};

// As many hexahedra as a mesh has in one direction, more or less: halving them doubles it. Fewer than 16 gain little. More gain time on
// refined meshes (59 k hexahedra: a band's closing takes 142 s in place of 155 s), none on others (7 k).
int degree_for(const Problem& problem) {
  const double part = problem.coarser() ? 1.6 : 1;
  return std::max(16, static_cast<int>(std::lround(part * std::cbrt(problem.mesh().all_hexes))));
}

// A polynomial of degree d inverts eigenvalues above so much of the largest one to within a third.
double smallest_for(int degree) { return 0.77 / (static_cast<double>(degree) * degree); }

}  // namespace

LinePressureStiffness::LinePressureStiffness(const CoupledSystem& system, const LineJacobi& lines)
    : mesh_(system.problem().mesh()), lines_(lines), b_(mesh_.hexes.size()), nodal_(mesh_.nodes()) {
  system.problem().solid().visit_constraints([&](int hex, std::span<const int> nodes, std::span<const double> b) {
    for (int a = 0; a < 7; ++a) {
      const auto at = 3 * (std::ranges::find(nodes, mesh_.hexes[hex][a + 1]) - nodes.begin());
      for (int i = 0; i < 3; ++i) b_[hex][a][i] = static_cast<float>(b[at + i]);
    }
  });
  const DofMap& dofs = system.problem().dofs();
  for (int n = 0; n < mesh_.owned; ++n)
    if (dofs.held(n)) held_.emplace_back(n, dofs.projector(n));
}

void LinePressureStiffness::apply(std::span<const double> p, std::span<double> q) const {
  std::ranges::fill(nodal_, Four{});
  for (std::size_t h = 0; h < b_.size(); ++h) {
    const Hex& hex = mesh_.hexes[h];
    Four sum{};
    for (int a = 0; a < 7; ++a) {
      const Four f = p[h] * __builtin_convertvector(b_[h][a], Four);
      nodal_[hex[a + 1]] += f;
      sum += f;
    }
    nodal_[hex[0]] -= sum;
  }
  mesh_.halo.fold(numbers(), 4);
  for (const auto& [n, P] : held_) {
    const Four f = nodal_[n];
    for (int i = 0; i < 3; ++i) nodal_[n][i] = P(i, 0) * f[0] + P(i, 1) * f[1] + P(i, 2) * f[2];
  }
  lines_.apply_nodal(numbers());
  mesh_.halo.update(numbers(), 4);
  for (std::size_t h = 0; h < b_.size(); ++h) {
    const Hex& hex = mesh_.hexes[h];
    const Four first = nodal_[hex[0]];
    Four sum{};
    for (int a = 0; a < 7; ++a) sum += __builtin_convertvector(b_[h][a], Four) * (nodal_[hex[a + 1]] - first);
    q[h] = sum[0] + sum[1] + sum[2];
  }
}

std::size_t LinePressureStiffness::bytes() const { return bytes_of(b_) + bytes_of(nodal_) + bytes_of(held_); }

struct PressureSchur::Weak {
  Weak(const CoupledSystem& system, const LineJacobi& lines, int degree)
      : K(system, lines), scale(system), inverse(K, scale, degree, smallest_for(degree), system.problem().comm()) {}
  LinePressureStiffness K;
  Diagonal scale;
  Chebyshev inverse;
};

PressureSchur::PressureSchur(const CoupledSystem& system, const LineJacobi* lines, const PressureSettings& settings)
    : system_(system), lines_(lines), settings_(settings), diagonal_(system.inverse_pressure_schur()) {}

void PressureSchur::strengthen() {
  if (!holds_back()) return;
  weak_ = std::make_shared<Weak>(system_, *lines_, settings_.degree > 0 ? settings_.degree : degree_for(system_.problem()));
  correction_.resize(diagonal_.size());
}

void PressureSchur::apply(std::span<const double> r, std::span<double> z) const {
  std::ranges::transform(diagonal_, r, z.begin(), std::multiplies{});
  if (!weak_) return;
  weak_->inverse.apply(r, correction_);
  for (std::size_t e = 0; e < z.size(); ++e) z[e] += settings_.weight * correction_[e];
}

std::size_t PressureSchur::bytes() const {
  return bytes_of(diagonal_) + (weak_ ? weak_->K.bytes() + weak_->scale.bytes() + weak_->inverse.bytes() + bytes_of(correction_) : 0);
}

}  // namespace bulbus
