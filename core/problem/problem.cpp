#include "core/problem/problem.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/did_you_mean.hpp"
#include "core/base/error.hpp"
#include "core/base/worse.hpp"
#include "core/problem/coarse_positions.hpp"
#include "core/problem/enclosed_parts.hpp"
#include "core/problem/validate.hpp"

namespace bulbus::inline problem {
namespace {

// Of a model that has been found valid.
std::vector<MeshLevel> valid_levels(const Mesh& base, int refinements, const Model& model, const Comm& comm) {
  validate(base, model);
  return distribute_levels(base, refinements, comm, shared_surfaces(base, model));
}

// Names that the model refers to as sets of nodes, and those of all regions.
std::set<std::string> sets_in_use(const LocalMesh& mesh, const Model& model) {
  std::set<std::string> names(mesh.region_names.begin(), mesh.region_names.end());
  for (const FixSpec& f : model.fix) names.insert(f.set);
  for (const StepSpec& s : model.steps) {
    for (const DisplaceSpec& d : s.displace) names.insert(d.set);
    for (const LoadSpec& l : s.loads)
      if (l.force) names.insert(l.set);
  }
  for (const ProbeSpec& p : model.probes)
    for (const std::string& set : {p.set, p.to})
      if (!set.empty()) names.insert(set);
  return names;
}

// A force without its counterpart, relative to the forces that meet there. What rounding leaves in the
// places, a strain of 1e-15 where the floor is one of 1e-7, is none.
double imbalance(double force, double reference_force, double floor) {
  constexpr double rounding = 1e-8;
  return force <= rounding * floor ? 0 : force / std::max(reference_force, floor);
}

// The same over what rounding may leave of it while the body moves: 1e-12 of the forces that cancel, or a
// strain of 1e-13 (places of 10 mm in cells of 0.01 mm).
double above_rounding(double force, double reference_force, double floor) {
  return force <= 0 ? 0 : force / std::max(1e-12 * reference_force, 1e-6 * floor);
}

// Of a liquid's |D| / V.
constexpr double volume_rounding = 1e-12;

}  // namespace

Problem::Problem(const Mesh& mesh, const Model& model, const Comm& comm)
    : Problem(valid_levels(mesh, 0, model, comm), model) {}

Problem::Problem(const MeshHierarchy& meshes, const Model& model, const Comm& comm)
    : Problem(valid_levels(meshes.base, meshes.refinements, model, comm), model) {}

Problem::Problem(std::vector<MeshLevel> levels, const Model& model)
    : model_(model), level_(std::move(levels.back())), mesh_(*level_.mesh) {
  levels.pop_back();
  build();
  if (levels.empty()) return;
  coarser_ = std::make_unique<Problem>(std::move(levels), model);
  coarser_->follows_ = true;
}

std::vector<MeshLevel> Problem::take_levels() && {
  std::vector<MeshLevel> levels;
  if (coarser_) levels = std::move(*coarser_).take_levels();
  levels.push_back(std::move(level_));
  return levels;
}

void Problem::build() {
  multiplicity_ = 1;
  enclosed_ = std::make_shared<EnclosedParts>();
  for (std::size_t i = 0; i < model_.symmetry.size(); ++i) multiplicity_ *= 2;
  build_bodies_and_solid();
  build_liquids();
  build_bars();
  hold_fixed();
}

State Problem::coarsened(const State& state) const {
  State coarse = coarser_->initial_state();
  level_.prolongation->inject(state.x, coarse.x);
  relax_inverted(*coarser_, coarse.x);
  const auto V0 = solid_->reference_volumes();
  for (std::size_t h = 0; h < coarse.lambda.size(); ++h) {
    double sum = 0, volume = 0;
    for (std::size_t child = 8 * h; child < 8 * h + 8; ++child)
      sum += V0[child] * state.lambda[child], volume += V0[child];
    coarse.lambda[h] = sum / volume;
  }
  coarse.P = state.P;
  coarse.bodies = state.bodies;
  return coarse;
}

const std::vector<int>& Problem::nodes_of(const std::string& set) const {
  const auto known = sets_in_use(mesh_, model_);
  if (const auto* nodes = mesh_.nodes_of(set); nodes && known.contains(set)) return *nodes;
  throw input_error("no hold, load or probe of the model names the set '" + set + "'",
                    did_you_mean(set, known, "name it in one of them"));
}

State Problem::initial_state() const {
  return {mesh_.X, std::vector<double>(mesh_.hexes.size()), std::vector<double>(liquids_.size()),
          std::vector<Pose>(dofs_->bodies().size())};
}

std::vector<std::shared_ptr<Term>> Problem::terms() const {
  std::vector<std::shared_ptr<Term>> all;
  for (const auto& [name, term] : bars_) all.push_back(term);
  for (const auto& [name, term] : loads_) all.push_back(term);
  all.insert(all.end(), fading_.begin(), fading_.end());
  all.insert(all.end(), added_.begin(), added_.end());
  return all;
}

bool Problem::symmetric() const {
  return std::ranges::all_of(terms(), [](const auto& t) { return t->symmetric(); });
}

void Problem::set_progress(double s, State& state) {
  s_ = s;
  for (const auto& term : terms()) term->set_progress(s);
  for (std::size_t i = 0; i < liquids_.size(); ++i) {
    liquids_[i].set_progress(s);
    if (!liquids_[i].enclosed()) state.P[i] = liquids_[i].given(s);
  }
  State coarse{.P = state.P};
  if (coarser_) coarser_->set_progress(s, coarse);
}

void Problem::end_step() {
  dofs_->freeze();
  for (const auto& term : terms()) term->freeze();
  for (Liquid& l : liquids_) l.freeze();
  if (coarser_) coarser_->end_step();
}

void Problem::predict(const Linearisation& tangents, std::span<const double> dx) {
  const auto all = terms();
  for (std::size_t i = 0; i < all.size(); ++i)
    if (tangents.terms[i]) all[i]->predict(*tangents.terms[i], dx);
}

bool Problem::update_multipliers(const State& state) {
  bool again = false;
  for (const auto& term : terms()) again |= term->update_multipliers(state);
  return again;
}

std::string Problem::refusal(const State& state) const {
  std::string first;
  for (const auto& term : terms())
    if (std::string refusal = term->refusal(state); first.empty()) first = std::move(refusal);
  return first;
}

Residual Problem::residual(const State& state) const {
  Residual r{std::vector<double>(state.x.size()),
             std::vector<double>(state.lambda.size()),
             {},
             std::vector<double>(mesh_.nodes())};
  solid_->residual(state.x, state.lambda, r.force, r.volume, r.reference_force);
  for (const auto& term : terms()) term->add_residual(state, r.force, r.reference_force);
  for (std::size_t i = 0; i < liquids_.size(); ++i) {
    const Liquid& l = liquids_[i];
    if (state.P[i] != 0) {
      std::vector<double> own(r.force.size());
      l.surface().add_gradient(state.x, -state.P[i], own);
      for (std::size_t k = 0; k < own.size(); ++k) r.force[k] += own[k];
      add_reference_force(own, r.reference_force);
    }
    r.liquid.push_back(l.violation(l.enclosed() ? l.volume(state.x) : 0, state.P[i]));
  }
  mesh_.halo.accumulate_ghosts(r.force);
  mesh_.halo.accumulate_ghosts(r.reference_force, 1);
  for (std::size_t k = 0; k < state.bodies.size(); ++k) r.bodies.push_back(resultant(k, state, r));
  return r;
}

Residual::Resultant Problem::resultant(std::size_t k, const State& state, const Residual& r) const {
  const RigidBody& body = dofs_->bodies()[k];
  const auto six = body.reduce(state.bodies[k], state.x, r.force, mesh_.owned);
  std::vector<double> sum(six.begin(), six.end());
  sum.resize(10);
  for (int n : body.nodes()) {
    if (n >= mesh_.owned) continue;
    const double arm = norm(body.arm(state.bodies[k], state.x, n));
    sum[6] += r.reference_force[n], sum[7] += arm * r.reference_force[n], sum[8] += arm, sum[9] += 1;
  }
  comm().sum(sum);
  return {{sum[0], sum[1], sum[2]}, {sum[3], sum[4], sum[5]}, sum[6], sum[7], sum[8] / sum[9]};
}

EquilibriumError Problem::equilibrium_error(const Residual& r) const {
  EquilibriumError b;
  const auto judge = [&](double force, double reference, double floor, const std::string& where) {
    const double relative = worse(0, imbalance(force, reference, floor));
    if (relative > b.force) b.force = relative, b.region = where;
    b.above_rounding.push_back(above_rounding(force, reference, floor));
  };
  std::vector<double> free(r.force);
  dofs_->project(free);
  // ‖A‖² and squared reference force norm of every region's nodes, reactions of held ones left out; the floor
  // keeps an unloaded region from dividing by round-off
  std::vector<double> sums(2 * region_nodes_.size());
  for (std::size_t g = 0; g < region_nodes_.size(); ++g)
    for (int n : region_nodes_[g]) {
      for (int c = 0; c < 3; ++c) sums[2 * g] += free[3 * n + c] * free[3 * n + c];
      if (!dofs_->fully_constrained(n)) sums[2 * g + 1] += r.reference_force[n] * r.reference_force[n];
    }
  comm().sum(sums);
  for (std::size_t g = 0; g < region_nodes_.size(); ++g)
    judge(std::sqrt(sums[2 * g]), std::sqrt(sums[2 * g + 1]), region_floor_[g], solid_->regions()[g].name);
  for (std::size_t k = 0; k < dofs_->bodies().size(); ++k) {
    // as the free nodes are: the resultants against the sum of the nodal magnitudes
    const Residual::Resultant& body = r.bodies[k];
    const std::string& name = dofs_->bodies()[k].name();
    judge(norm(body.force), body.reference_force, body_floor_[k], name);
    judge(norm(body.moment), body.reference_moment, body_floor_[k] * body.arm, name);
  }
  const auto V0 = solid_->reference_volumes();
  for (std::size_t e = 0; e < r.volume.size(); ++e) b.volume = worse(b.volume, std::abs(r.volume[e] / V0[e]));
  b.volume = comm().max(b.volume);
  for (std::size_t i = 0; i < liquids_.size(); ++i) {
    const double relative = std::abs(r.liquid[i] / liquids_[i].scale());
    b.liquid = worse(b.liquid, relative);
    b.above_rounding.push_back(relative / volume_rounding);
  }
  return b;
}

Linearisation Problem::linearise(std::shared_ptr<const State> state, double gamma,
                                 StrainSource source) const {
  const auto all = terms();
  std::vector<std::shared_ptr<const TermTangent>> tangents;
  for (const auto& term : all) tangents.push_back(term->tangent(state));
  return {state,
          SolidTangent(solid_, SharedNumbers(state, &state->x), SharedNumbers(state, &state->lambda), gamma,
                       source),
          std::move(tangents), static_cast<int>(all.size() - added_.size())};
}

double Linearisation::solve_tolerance() const {
  double least = 1;
  for (const auto& tangent : terms)
    if (tangent) least = std::min(least, tangent->solve_tolerance());
  return least;
}

}  // namespace bulbus::inline problem
