#include "precond/line_pressure_stiffness.hpp"

#include <algorithm>

#include "core/base/memory.hpp"

namespace bulbus {

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

Eigen::Vector3f LinePressureStiffness::constraint(int hex, int corner) const {
  const auto& b = b_[hex];
  FourSingle at = b[std::max(0, corner - 1)];
  if (corner == 0) at = -(b[0] + b[1] + b[2] + b[3] + b[4] + b[5] + b[6]);
  return {at[0], at[1], at[2]};
}

std::size_t LinePressureStiffness::bytes() const { return bytes_of(b_) + bytes_of(nodal_) + bytes_of(held_); }

}  // namespace bulbus
