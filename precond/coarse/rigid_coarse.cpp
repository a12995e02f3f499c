#include "precond/coarse/rigid_coarse.hpp"

#include <algorithm>
#include <utility>

#include "core/base/memory.hpp"

namespace bulbus::inline precond {

namespace {

// Half a million nodes' coarse matrix, the largest whose factors were tried: 6 GB (docs/decisions/052).
constexpr int most_factorised = 200000;

}  // namespace

RigidPlan::RigidPlan(const CoupledSystem& system, int nodes, Precision precision, int most)
    : symmetric(system.problem().symmetric()),
      precision(precision),
      groups(aggregate(system, nodes)),
      matrix(symmetric),
      factor(system.problem().comm(), {.precision = precision}) {
  const Comm& comm = system.problem().comm();
  if (precision == Precision::single && 6 * groups.total > most)
    levels = std::make_shared<HierarchyPlan>(comm, most);
}

bool RigidPlan::fits(const Problem& problem, Precision wanted) const {
  const bool precise = wanted == Precision::single || precision == Precision::full || levels;
  return precise && symmetric == problem.symmetric() && hold_every_free_node(groups, problem);
}

RigidCoarse::RigidCoarse(const CoupledSystem& system, std::shared_ptr<RigidPlan> plan)
    : layout_(system.layout()), plan_(std::move(plan)), modes_(rigid_modes(system, plan_->groups)) {
  plan_->matrix.clear();
  const int bodies = system.problem().comm().rank() == 0 ? plan_->groups.bodies : 0;
  coarse_.resize(6 * (bodies + plan_->groups.mine));
}

void RigidCoarse::factorise(const CoupledSystem& system, const KeepFactors& keep) {
  if (system.problem().comm().rank() == 0)
    for (const auto& e : system.body_extra())
      if (!plan_->symmetric || e.row <= e.column) plan_->matrix.add(e.row, e.column, e.value);
  for (int k : modes_.missing) plan_->matrix.add(k, k, system.constrained_diagonal());
  plan_->matrix.shrink();
  const auto frames = std::exchange(modes_.frames, {});
  if (plan_->levels && make_levels(system, frames)) return;
  const FactorReport f =
      plan_->factor.factorise(plan_->matrix.triplets(), coarse_size(), plan_->symmetric, keep);
  keeps_factors_ = f.kept;
  if (!f.ok) setup_error_ = "rigid motions of aggregates: " + f.reason;
  factor_bytes_ = static_cast<std::size_t>(f.memory_max_mb * 1e6);
}

bool RigidCoarse::could_be_factorised() const { return levels_ && coarse_size() <= most_factorised; }

// Returns false where they are of no use.
bool RigidCoarse::make_levels(const CoupledSystem& system, const std::vector<RigidFrame>& frames) {
  const Aggregates& groups = plan_->groups;
  const Comm& comm = system.problem().comm();
  const int bodies = comm.rank() == 0 ? groups.bodies : 0, first = groups.first - bodies,
            mine = bodies + groups.mine;
  levels_ = std::make_unique<BlockHierarchy>(
      assemble_blocks(comm, mine, [&](const BlockVisitor& visit) { plan_->matrix.visit(visit); }),
      std::vector(frames.begin() + first, frames.begin() + first + mine), bodies,
      system.constrained_diagonal(), plan_->levels);
  if (!levels_->stable()) levels_.reset();
  if (!levels_) return false;
  plan_->matrix.release();
  setup_error_ = levels_->setup_error();
  factor_bytes_ = levels_->bytes();
  return true;
}

void RigidCoarse::apply(std::span<const double> b, std::span<double> x) const {
  const int owned = layout_.nodal / 3;
  const int bodies = layout_.bodies;  // six numbers each, on rank 0
  const auto part = [&](int n) { return bodies + 6 * (plan_->groups.of[n] - plan_->groups.first); };
  std::ranges::fill(coarse_, 0);
  std::copy_n(&b[3 * owned], bodies, coarse_.begin());
  for (int n = 0; n < owned; ++n)
    if (plan_->groups.of[n] >= 0) {
      double* to = &coarse_[part(n)];
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 6; ++k) to[k] += modes_.of[n][i][k] * b[3 * n + i];
    }
  if (levels_)
    levels_->apply(coarse_, coarse_);
  else
    plan_->factor.solve(coarse_, coarse_);
  std::ranges::fill(x, 0);
  std::copy_n(coarse_.begin(), bodies, &x[3 * owned]);
  for (int n = 0; n < owned; ++n)
    if (plan_->groups.of[n] >= 0) {
      const double* from = &coarse_[part(n)];
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 6; ++k) x[3 * n + i] += modes_.of[n][i][k] * from[k];
    }
}

std::size_t RigidCoarse::bytes() const {
  return bytes_of(modes_.of) + bytes_of(plan_->groups.of) + plan_->matrix.bytes() + factor_bytes_ +
         bytes_of(coarse_);
}

}  // namespace bulbus::inline precond
