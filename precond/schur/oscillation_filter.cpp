#include "precond/schur/oscillation_filter.hpp"

#include <algorithm>

#include "core/base/memory.hpp"

namespace bulbus::inline precond {
namespace {

// u·A u over u·L u: in a film neighbours move along, and add what they have in common with a line to the 4/9
// of it that is the line's own, 9/4 together; in a bulk they help to carry and leave less than 1. Between
// both (docs/decisions/009).
constexpr double film = 1.5;

}  // namespace

OscillationFilter::OscillationFilter(const Problem& problem, std::vector<char> let_through)
    : mesh_(problem.mesh()),
      regions_(problem.solid().regions()),
      let_through_(std::move(let_through)),
      nodal_(2 * mesh_.nodes()) {
  let_through_.resize(mesh_.hexes.size());
}

void OscillationFilter::apply(std::span<double> p) const {
  for (const SolidRegion& r : regions_) {
    std::ranges::fill(nodal_, 0.0);  // sum and number at every node
    for (int h = r.first; h < r.first + r.count; ++h)
      if (!let_through_[h])
        for (int n : mesh_.hexes[h]) nodal_[2 * n] += p[h], nodal_[2 * n + 1] += 1;
    mesh_.halo.accumulate_ghosts(nodal_, 2);
    for (int n = 0; n < mesh_.owned; ++n)
      if (nodal_[2 * n + 1] > 0) nodal_[2 * n] /= 8 * nodal_[2 * n + 1];
    mesh_.halo.update_ghosts(nodal_, 2);
    for (int h = r.first; h < r.first + r.count; ++h)
      if (!let_through_[h])
        for (int n : mesh_.hexes[h]) p[h] -= nodal_[2 * n];
  }
}

std::size_t OscillationFilter::bytes() const { return bytes_of(let_through_) + bytes_of(nodal_); }

// u = L⁻¹ f of uniform loads in x, y and z, so that u·L u = u·f
std::vector<char> carried_by_lines(const CoupledSystem& system, const LineJacobi& lines) {
  const LocalMesh& mesh = system.problem().mesh();
  const DofMap& dofs = system.problem().dofs();
  const std::size_t size = system.layout().primal(), nodal = system.layout().nodal;
  std::vector<double> f(size), u(size), Au(size), surplus(mesh.nodes());  // u·(A u − film f) of every node
  for (int c = 0; c < 3; ++c) {
    std::ranges::fill(f, 0);
    for (int n = 0; n < mesh.owned; ++n) f[3 * n + c] = 1;
    dofs.project(std::span(f).first(nodal));
    lines.apply(f, u);
    dofs.project(std::span(u).first(nodal));
    system.apply_displacement(u, Au);
    for (int n = 0; n < mesh.owned; ++n)
      for (int i = 3 * n; i < 3 * n + 3; ++i) surplus[n] += u[i] * (Au[i] - film * f[i]);
  }
  mesh.halo.update_ghosts(surplus, 1);
  std::vector<char> carried(mesh.hexes.size());
  for (std::size_t h = 0; h < carried.size(); ++h) {
    double sum = 0;
    for (int n : mesh.hexes[h]) sum += surplus[n];
    carried[h] = sum >= 0;
  }
  return carried;
}

}  // namespace bulbus::inline precond
