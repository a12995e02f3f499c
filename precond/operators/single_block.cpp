#include "precond/operators/single_block.hpp"

#include <algorithm>

#include "core/base/memory.hpp"
#include "core/solve/reduced.hpp"

namespace bulbus::inline precond {

SingleBlock::SingleBlock(SharedSystem system)
    : size_(system->layout().primal()), dofs_(system->problem().dofs()), d_(*system), z_(*system) {
  while (free_ < system->problem().mesh().owned && dofs_.constrained(free_)) ++free_;
  refresh(std::move(system));
}

void SingleBlock::refresh(SharedSystem system) {
  system_ = std::move(system);
  touched_.clear();
  system_->visit_surface([&](std::span<const int> nodes, std::span<const double>) {
    touched_.insert(touched_.end(), nodes.begin(), nodes.end());
  });
  for (const RigidBody& b : dofs_.bodies())
    touched_.insert(touched_.end(), b.nodes().begin(), b.nodes().end());
  std::ranges::sort(touched_);
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  touched_.shrink_to_fit();
}

void SingleBlock::apply() const {
  const LocalMesh& mesh = system_->problem().mesh();
  auto& dx = system_->workspace().increment;
  dx.resize(3 * static_cast<std::size_t>(mesh.nodes()));
  mesh.halo.update_ghosts(d_.nodal);
  for (int n : touched_)
    for (int c = 0; c < 3; ++c) dx[3 * n + c] = d_.nodal[n][c];
  dofs_.expand_bodies(system_->state(), d_.bodies, dx);
  for (const RigidBody& b : dofs_.bodies())
    for (int n : b.nodes()) d_.nodal[n] = rounded(&dx[3 * n]);
  act(dx);
}

void SingleBlock::apply_to(std::span<const double> x) const {
  auto& dx = system_->workspace().increment;
  dx.resize(3 * d_.nodal.size());
  dofs_.expand(system_->state(), x, dx);
  std::ranges::copy(x.subspan(system_->layout().nodal), d_.bodies.begin());
  // relative to a free node: hexahedra do not feel a translation, and rounding it would drown their strain
  Vec3<double> shift{};
  if (free_ < system_->problem().mesh().owned)
    std::copy_n(&dx[3 * static_cast<std::size_t>(free_)], 3, shift.begin());
  for (std::size_t n = 0; n < d_.nodal.size(); ++n)
    for (int c = 0; c < 3; ++c) d_.nodal[n][c] = static_cast<float>(dx[3 * n + c] - shift[c]);
  act(dx);
}

// z += A d, with dx where hexahedra are not alone.
void SingleBlock::act(std::span<const double> dx) const {
  const Problem& problem = system_->problem();
  const int owned = problem.mesh().owned;
  std::fill(z_.nodal.begin() + owned, z_.nodal.end(), NodeSingle{});
  system_->solid().apply_single(d_.nodal, z_.nodal);
  auto& force = system_->workspace().force;
  force.resize(dx.size());
  for (int n : touched_) std::fill_n(&force[3 * n], 3, 0);
  system_->add_surface_action(dx, force);
  for (int n : touched_) z_.nodal[n] += rounded(&force[3 * n]);
  problem.mesh().halo.accumulate_ghosts(z_.nodal);
  for (const RigidBody& b : dofs_.bodies())
    for (int n : b.nodes())
      for (int c = 0; c < 3; ++c) force[3 * n + c] = z_.nodal[n][c];
  const auto q = dofs_.reduce_bodies(system_->state(), force);
  for (std::size_t i = 0; i < z_.bodies.size(); ++i) z_.bodies[i] += q[i];
  system_->add_body_geometry(d_.bodies, z_.bodies);
  dofs_.project(z_.nodal);
}

void SingleBlock::apply(std::span<const double> x, std::span<double> y) const {
  const std::size_t owned = system_->problem().mesh().owned;
  apply_to(x);
  for (std::size_t n = 0; n < owned; ++n)
    for (int c = 0; c < 3; ++c) y[3 * n + c] = z_.nodal[n][c];
  std::ranges::copy(z_.bodies, y.begin() + 3 * owned);
  dofs_.add_constrained(x, system_->constrained_diagonal(), y);
  std::ranges::fill(z_.nodal, NodeSingle{});
  std::ranges::fill(z_.bodies, 0);
}

std::size_t SingleBlock::bytes() const { return d_.bytes() + z_.bytes() + bytes_of(touched_); }

}  // namespace bulbus::inline precond
