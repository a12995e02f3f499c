#include "precond/line_pressure_stiffness.hpp"

#include <algorithm>

#include "core/base/memory.hpp"

namespace bulbus {

LinePressureStiffness::LinePressureStiffness(const CoupledSystem& system, const LineJacobi& lines)
    : solid_(system.problem().solid()), mesh_(system.problem().mesh()), lines_(lines), nodal_(mesh_.nodes()) {
  const DofMap& dofs = system.problem().dofs();
  for (int n = 0; n < mesh_.owned; ++n)
    if (dofs.held(n)) held_.emplace_back(n, dofs.projector(n));
}

void LinePressureStiffness::apply(std::span<const double> p, std::span<double> q) const {
  std::ranges::fill(nodal_, NodeSingle{});
  solid_.apply_pressure_single(p, nodal_);
  mesh_.halo.fold(nodal_);
  for (const auto& [n, P] : held_) {
    const NodeSingle f = nodal_[n];
    for (int i = 0; i < 3; ++i) nodal_[n][i] = static_cast<float>(P(i, 0) * f[0] + P(i, 1) * f[1] + P(i, 2) * f[2]);
  }
  lines_.apply(nodal_);
  mesh_.halo.update(nodal_);
  solid_.volume_change_single(nodal_, q);
  for (int h : solid_.rigid_hexes()) q[h] = 0;
}

std::size_t LinePressureStiffness::bytes() const { return bytes_of(nodal_) + bytes_of(held_); }

}  // namespace bulbus
