#include "precond/schur/line_pressure_stiffness.hpp"

#include <algorithm>

#include "core/base/memory.hpp"

namespace bulbus::inline precond {

LinePressureStiffness::LinePressureStiffness(SharedSystem system, std::shared_ptr<const LineJacobi> lines)
    : problem_(system->problem()),
      system_(std::move(system)),
      lines_(std::move(lines)),
      nodal_(problem_.mesh().nodes()) {}

void LinePressureStiffness::apply(std::span<const double> p, std::span<double> q) const {
  const SolidTangent& solid = system_->solid();
  const Halo& halo = problem_.mesh().halo;
  std::ranges::fill(nodal_, NodeSingle{});
  solid.apply_pressure_single(p, nodal_);
  halo.accumulate_ghosts(nodal_);
  problem_.dofs().project(nodal_);
  lines_->apply(nodal_);
  halo.update_ghosts(nodal_);
  solid.volume_change_single(nodal_, q);
  for (int h : problem_.solid().rigid_hexes()) q[h] = 0;
}

std::size_t LinePressureStiffness::bytes() const { return bytes_of(nodal_); }

}  // namespace bulbus::inline precond
