#include "core/solve/coupled_system.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/inner_product.hpp"
#include "core/base/memory.hpp"
#include "core/solve/reduced.hpp"

namespace bulbus::inline solve {
namespace {

StrainSource strain_source(TangentStorage op) {
  return op == TangentStorage::cache ? StrainSource::cache : StrainSource::recompute;
}

}  // namespace

Layout layout_of(const Problem& problem) {
  const LocalMesh& mesh = problem.mesh();
  return {3 * mesh.owned, problem.dofs().tail_size(), static_cast<int>(mesh.hexes.size()),
          mesh.comm.rank() == 0 ? static_cast<int>(problem.liquids().size()) : 0};
}

CoupledSystem::CoupledSystem(const Problem& problem, const LinearSettings& settings, State state,
                             const Residual& r, std::vector<std::shared_ptr<const TermTangent>> further)
    : problem_(problem),
      settings_(settings),
      tangents_(problem.linearise(std::make_shared<const State>(std::move(state)), settings.gamma,
                                  strain_source(settings.op))),
      further_(std::move(further)),
      layout_(layout_of(problem)) {
  for (const Liquid& liquid : problem.liquids()) compliance_.push_back(liquid.compliance());
  compute_body_geometry(r);
  compute_liquid_columns();
  if (settings_.op == TangentStorage::assembled)
    assembled_ = std::make_unique<BlockCsr>(problem.mesh().nodes(), [&](const ContributionVisitor& v) {
      solid().visit(v, true);
      visit_surface(v);
    });
  compute_blocks();
}

void CoupledSystem::compute_body_geometry(const Residual& r) {
  for (std::size_t b = 0; b < state().bodies.size(); ++b) {
    Mat3<double> G =
        problem_.dofs().bodies()[b].geometric(state().bodies[b], state().x, r.force, problem_.mesh().owned);
    problem_.comm().sum(std::span(&G(0, 0), 9));
    body_geometry_.push_back(G);
  }
}

void CoupledSystem::compute_liquid_columns() {
  const auto& liquids = problem_.liquids();
  g_.assign(liquids.size(), {});
  for (std::size_t i = 0; i < liquids.size(); ++i) {
    if (!liquids[i].enclosed()) continue;
    std::vector<double> local(state().x.size());
    liquids[i].surface().add_gradient(state().x, 1, local);
    problem_.mesh().halo.accumulate_ghosts(local);
    g_[i].resize(layout_.primal());
    problem_.dofs().reduce(state(), local, g_[i]);
  }
}

std::vector<double> CoupledSystem::liquid_fluxes(std::span<const double> primal) const {
  std::vector<double> flux;
  for (const auto& g : g_) flux.push_back(local_inner_product(g, primal.first(g.size())));
  problem_.comm().sum(flux);
  return flux;
}

template <class Use>
void CoupledSystem::for_each_term(Use use) const {
  for (const auto& tangent : tangents_.terms)
    if (tangent) use(*tangent);
  for (const auto& tangent : further_) use(*tangent);
}

void CoupledSystem::add_surface_action(std::span<const double> dx, std::span<double> force) const {
  for_each_term([&](const TermTangent& tangent) { tangent.add_action(dx, force); });
  for (std::size_t i = 0; i < state().P.size(); ++i)
    if (state().P[i] != 0) problem_.liquids()[i].surface().add_stiffness(state().x, -state().P[i], dx, force);
}

std::span<double> CoupledSystem::nodal_action(std::span<const double> dx, std::span<const double> dlambda,
                                              std::span<double> volume) const {
  auto& force = workspace_.force;
  force.assign(dx.size(), 0);
  if (assembled_) {
    assembled_->apply(dx, force);
    if (!dlambda.empty()) solid().apply_pressure(dlambda, force);
    if (!volume.empty()) solid().volume_change(dx, volume);
  } else {
    solid().apply(dx, dlambda, force, volume);
    add_surface_action(dx, force);
  }
  problem_.mesh().halo.accumulate_ghosts(force);
  return force;
}

void CoupledSystem::visit_surface(const ContributionVisitor& visitor) const {
  for_each_term([&](const TermTangent& tangent) { tangent.visit(visitor); });
  for (std::size_t i = 0; i < state().P.size(); ++i)
    if (state().P[i] != 0) problem_.liquids()[i].surface().visit(state().x, -state().P[i], visitor);
}

void CoupledSystem::visit_added(const ContributionVisitor& visitor) const {
  for (const auto& tangent : std::span(tangents_.terms).subspan(tangents_.added))
    if (tangent) tangent->visit(visitor);
  for (const auto& tangent : further_) tangent->visit(visitor);
}

void CoupledSystem::add_body_geometry(std::span<const double> x, std::span<double> y) const {
  if (layout_.bodies == 0) return;
  for (std::size_t b = 0; b < body_geometry_.size(); ++b) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) y[6 * b + 3 + i] += body_geometry_[b](i, j) * x[6 * b + 3 + j];
    for (int i = 0; i < 6; ++i)
      if (!problem_.dofs().bodies()[b].free()[i]) y[6 * b + i] = constrained_diagonal_ * x[6 * b + i];
  }
}

std::vector<CoupledSystem::Entry> CoupledSystem::body_extra() const {
  std::vector<Entry> extra;
  for (int b = 0; b < static_cast<int>(body_geometry_.size()); ++b) {
    const auto& free = problem_.dofs().bodies()[b].free();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) extra.push_back({6 * b + 3 + i, 6 * b + 3 + j, body_geometry_[b](i, j)});
    for (int i = 0; i < 6; ++i)
      if (!free[i]) extra.push_back({6 * b + i, 6 * b + i, constrained_diagonal_});
  }
  return extra;
}

void CoupledSystem::apply_displacement(std::span<const double> x, std::span<double> y) const {
  const DofMap& dofs = problem_.dofs();
  auto& dx = workspace_.increment;
  dx.resize(state().x.size());
  dofs.expand(state(), x, dx);
  dofs.reduce(state(), nodal_action(dx, {}, {}), y);
  dofs.add_constrained(x, constrained_diagonal_, y);
  add_body_geometry(x.subspan(layout_.nodal), y.subspan(layout_.nodal));
}

void CoupledSystem::apply_tissue(std::span<const double> xu, std::span<const double> xl, std::span<double> yu,
                                 std::span<double> yl) const {
  const DofMap& dofs = problem_.dofs();
  auto& dx = workspace_.increment;
  dx.resize(state().x.size());
  dofs.expand(state(), xu, dx);
  dofs.reduce(state(), nodal_action(dx, xl, yl), yu);
  for (int e : problem_.solid().rigid_hexes()) yl[e] = -rigid_compliance(e) * xl[e];
  dofs.add_constrained(xu, constrained_diagonal_, yu);
  add_body_geometry(xu.subspan(layout_.nodal), yu.subspan(layout_.nodal));
}

std::vector<double> CoupledSystem::prescribed_fluxes(std::span<const double> increments) const {
  std::vector<double> flux(g_.size());
  for (std::size_t i = 0; i < g_.size(); ++i)
    if (problem_.liquids()[i].enclosed()) {
      std::vector<double> g(increments.size());
      problem_.liquids()[i].surface().add_gradient(state().x, 1, g);
      flux[i] = local_inner_product(g, increments);  // this rank's faces; increments are known on ghosts
    }
  problem_.comm().sum(flux);
  return flux;
}

void CoupledSystem::add_pressure_force(std::span<const double> lambda, double factor,
                                       std::span<double> primal) const {
  auto& force = workspace_.force;
  force.assign(state().x.size(), 0);
  solid().apply_pressure(lambda, force);
  problem_.mesh().halo.accumulate_ghosts(force);
  auto& projected = workspace_.increment;
  projected.resize(std::max<std::size_t>(force.size(), layout_.primal()));
  const auto reduced = std::span(projected).first(layout_.primal());
  problem_.dofs().reduce(state(), force, reduced);
  add_scaled(reduced, factor, primal);
}

double CoupledSystem::rigid_compliance(int hex) const {
  return problem_.solid().reference_volumes()[hex] / ((1 + settings_.gamma) * solid().shear_moduli()[hex]);
}

std::vector<double> CoupledSystem::inverse_pressure_schur() const {
  const auto V0 = problem_.solid().reference_volumes(), mu = solid().shear_moduli();
  std::vector<double> s(V0.size());
  for (std::size_t e = 0; e < s.size(); ++e) s[e] = (1 + settings_.gamma) * mu[e] / V0[e];
  return s;
}

// Of every node and body, without what holds add.
std::vector<double> CoupledSystem::sum_blocks(std::vector<std::array<double, 36>>& bodies) const {
  const LocalMesh& mesh = problem_.mesh();
  std::vector<double> blocks(9 * static_cast<std::size_t>(mesh.nodes()));
  bodies.assign(state().bodies.size(), {});
  for_each_condensed_matrix(*this, Matrices::augmented,
                            [&](std::span<const int> d, std::span<const double> K) {
                              const std::size_t n = d.size();
                              for (std::size_t i = 0; i < n;) {
                                const bool nodal = d[i] < 3 * mesh.nodes();
                                const int width = nodal ? 3 : 6;
                                double* block = nodal ? &blocks[3 * static_cast<std::size_t>(d[i])]
                                                      : bodies[(d[i] - 3 * mesh.nodes()) / 6].data();
                                for (int r = 0; r < width; ++r)
                                  for (int c = 0; c < width; ++c)
                                    block[width * r + c] += K[(i + r) * n + i + c];
                                i += width;
                              }
                            });
  mesh.halo.accumulate_ghosts(blocks, 9);
  blocks.resize(9 * static_cast<std::size_t>(mesh.owned));
  return blocks;
}

void CoupledSystem::add_constrained_blocks(std::span<double> blocks) const {
  for (int n = 0; n < problem_.mesh().owned; ++n)
    if (problem_.dofs().constrained(n)) {
      const auto block = constrained_block(n);
      for (int i = 0; i < 9; ++i) blocks[9 * static_cast<std::size_t>(n) + i] += block[i];
    }
}

std::array<double, 9> CoupledSystem::constrained_block(int node) const {
  const Mat3<double> P = problem_.dofs().projector(node);
  std::array<double, 9> block;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) block[3 * i + j] = constrained_diagonal_ * ((i == j) - P(i, j));
  return block;
}

std::vector<double> CoupledSystem::nodal_blocks() const {
  std::vector<std::array<double, 36>> bodies;
  auto blocks = sum_blocks(bodies);
  add_constrained_blocks(blocks);
  return blocks;
}

void CoupledSystem::compute_blocks() {
  const DofMap& dofs = problem_.dofs();
  auto blocks = sum_blocks(body_blocks_);
  double sum = 0, count = 0;
  for (int n = 0; n < problem_.mesh().owned; ++n)
    if (!dofs.constrained(n)) sum += blocks[9 * n] + blocks[9 * n + 4] + blocks[9 * n + 8], count += 3;
  sum = problem_.comm().sum(sum), count = problem_.comm().sum(count);
  constrained_diagonal_ = count > 0 && sum > 0 ? sum / count : 1;
  for (std::size_t b = 0; b < body_blocks_.size(); ++b) {
    auto& K = body_blocks_[b];
    problem_.comm().sum(K);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) K[6 * (3 + i) + 3 + j] += body_geometry_[b](i, j);
    for (int i = 0; i < 6; ++i)
      if (!dofs.bodies()[b].free()[i]) K[7 * i] = constrained_diagonal_;
  }
  add_constrained_blocks(blocks);
  compute_scaling(blocks);
}

void CoupledSystem::compute_scaling(const std::vector<double>& blocks) {
  constexpr double least = 1e-3;  // of a node's mean: no direction is scaled up by more than 30 times as much
  scaling_.assign(layout_.size(), 1);
  for (int n = 0; n < problem_.mesh().owned; ++n) {
    const double* B = &blocks[9 * static_cast<std::size_t>(n)];
    const double mean = (std::abs(B[0]) + std::abs(B[4]) + std::abs(B[8])) / 3;
    for (int c = 0; c < 3; ++c)
      scaling_[3 * n + c] = 1 / std::sqrt(std::max(std::abs(B[4 * c]), least * mean));
  }
  for (int i = 0; i < layout_.bodies; ++i)
    scaling_[layout_.nodal + i] = 1 / std::sqrt(std::max(std::abs(body_blocks_[i / 6][7 * (i % 6)]), 1e-300));
  const auto schur = inverse_pressure_schur();
  for (int e = 0; e < layout_.hexes; ++e) scaling_[layout_.primal() + e] = std::sqrt(schur[e]);
  std::vector<double> own(g_.size());
  for (std::size_t i = 0; i < g_.size() && !eliminated(); ++i)
    for (std::size_t k = 0; k < g_[i].size(); ++k) own[i] += std::pow(g_[i][k] * scaling_[k], 2);
  problem_.comm().sum(own);
  for (int i = 0; i < layout_.liquids; ++i)
    scaling_[layout_.primal() + layout_.hexes + i] = 1 / std::sqrt(compliance(i) + own[i]);
}

std::size_t CoupledSystem::bytes() const {
  std::size_t total = bytes_of(scaling_) + bytes_of(workspace_.increment) + bytes_of(workspace_.force);
  for (const auto& g : g_) total += bytes_of(g);
  return total + (assembled_ ? assembled_->bytes() : 0);
}

}  // namespace bulbus::inline solve
