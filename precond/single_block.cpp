#include "precond/single_block.hpp"

#include <algorithm>

#include "core/base/memory.hpp"
#include "core/solve/reduced.hpp"

namespace bulbus {
namespace {

NodeSingle rounded(const double* v) { return NodeSingle{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), 0}; }

}  // namespace

SingleBlock::SingleBlock(const CoupledSystem& system) : system_(system), dofs_(system.problem().dofs()), d_(system), z_(system) {
  for (int n = 0; n < system.problem().mesh().owned; ++n)
    if (dofs_.held(n)) held_.emplace_back(n, dofs_.projector(n));
    else if (free_ < 0) free_ = n;
  follow();
}

void SingleBlock::follow() {
  touched_.clear();
  visit_surface(system_.problem(), system_.state(), [&](std::span<const int> nodes, std::span<const double>) {
    touched_.insert(touched_.end(), nodes.begin(), nodes.end());
  });
  for (const RigidBody& b : dofs_.bodies()) touched_.insert(touched_.end(), b.nodes().begin(), b.nodes().end());
  std::ranges::sort(touched_);
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  touched_.shrink_to_fit();
}

void SingleBlock::project(std::span<NodeSingle> v) const {
  for (const auto& [n, P] : held_) {
    const NodeSingle f = v[n];
    for (int i = 0; i < 3; ++i) v[n][i] = static_cast<float>(P(i, 0) * f[0] + P(i, 1) * f[1] + P(i, 2) * f[2]);
  }
}

void SingleBlock::apply() const {
  const LocalMesh& mesh = system_.problem().mesh();
  auto& dx = system_.room().dx;
  dx.resize(3 * static_cast<std::size_t>(mesh.nodes()));
  mesh.halo.update(d_.nodal);
  for (int n : touched_)
    for (int c = 0; c < 3; ++c) dx[3 * n + c] = d_.nodal[n][c];
  const auto q = dofs_.bodies_part(d_.bodies);
  for (std::size_t b = 0; b < dofs_.bodies().size(); ++b) {
    RigidBody::Six six;
    std::copy_n(&q[6 * b], 6, six.begin());
    dofs_.bodies()[b].expand(system_.state().bodies[b], system_.state().x, six, dx);
    for (int n : dofs_.bodies()[b].nodes()) d_.nodal[n] = rounded(&dx[3 * n]);
  }
  act(dx);
}

void SingleBlock::apply_to(std::span<const double> x) const {
  auto& dx = system_.room().dx;
  dx.resize(3 * d_.nodal.size());
  dofs_.expand(system_.state(), x, dx);
  std::ranges::copy(x.subspan(system_.layout().nodal), d_.bodies.begin());
  // relative to a free node: hexahedra do not feel a translation, and rounding it would drown their strain
  Vec3<double> shift{};
  if (free_ >= 0) std::copy_n(&dx[3 * static_cast<std::size_t>(free_)], 3, shift.begin());
  for (std::size_t n = 0; n < d_.nodal.size(); ++n)
    for (int c = 0; c < 3; ++c) d_.nodal[n][c] = static_cast<float>(dx[3 * n + c] - shift[c]);
  act(dx);
}

// z += A d, with dx where hexahedra are not alone.
void SingleBlock::act(std::span<const double> dx) const {
  const Problem& problem = system_.problem();
  const int owned = problem.mesh().owned;
  std::fill(z_.nodal.begin() + owned, z_.nodal.end(), NodeSingle{});
  problem.solid().apply_single(d_.nodal, z_.nodal);
  auto& force = system_.room().force;
  force.resize(dx.size());
  for (int n : touched_) std::fill_n(&force[3 * n], 3, 0);
  system_.add_surface_action(dx, force);
  for (int n : touched_) z_.nodal[n] += rounded(&force[3 * n]);
  problem.mesh().halo.fold(z_.nodal);
  if (!dofs_.bodies().empty()) {
    std::vector<double> all;
    for (std::size_t b = 0; b < dofs_.bodies().size(); ++b) {
      const RigidBody& body = dofs_.bodies()[b];
      for (int n : body.nodes())
        for (int c = 0; c < 3; ++c) force[3 * n + c] = z_.nodal[n][c];
      const auto six = body.reduce(system_.state().bodies[b], system_.state().x, force, owned);
      all.insert(all.end(), six.begin(), six.end());
    }
    problem.comm().sum(all);
    for (std::size_t i = 0; i < z_.bodies.size(); ++i) z_.bodies[i] += all[i];
    system_.add_body_geometry(d_.bodies, z_.bodies);
  }
  project(z_.nodal);
}

void SingleBlock::apply(std::span<const double> x, std::span<double> y) const {
  const std::size_t owned = system_.problem().mesh().owned, nodal = 3 * owned;
  const double scale = system_.held_scale();
  std::ranges::fill(z_.nodal, NodeSingle{});
  std::ranges::fill(z_.bodies, 0);
  apply_to(x);
  for (std::size_t n = 0; n < owned; ++n)
    for (int c = 0; c < 3; ++c) y[3 * n + c] = z_.nodal[n][c];
  for (const auto& [n, P] : held_)
    for (int i = 0; i < 3; ++i) {
      y[3 * n + i] += scale * x[3 * n + i];
      for (int j = 0; j < 3; ++j) y[3 * n + i] -= scale * P(i, j) * x[3 * n + j];
    }
  std::ranges::copy(z_.bodies, y.begin() + nodal);
  std::ranges::fill(z_.nodal, NodeSingle{});
  std::ranges::fill(z_.bodies, 0);
}

std::size_t SingleBlock::bytes() const { return d_.bytes() + z_.bytes() + bytes_of(held_) + bytes_of(touched_); }

}  // namespace bulbus
