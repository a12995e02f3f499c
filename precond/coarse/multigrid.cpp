#include "precond/coarse/multigrid.hpp"

#include "core/base/memory.hpp"
#include "precond/amg/assembled.hpp"
#include "precond/operators/correct.hpp"
#include "precond/operators/projected_tangent.hpp"

namespace bulbus::inline precond {

MultigridPlan::MultigridPlan(const Problem& finest, const LinearSettings& settings)
    : settings_(settings),
      base_(std::make_shared<Mumps>(
          finest.comm(), MumpsOptions{.precision = settings.smoothing, .block = 3, .joined = true})) {
  for (const Problem* fine = &finest; fine->coarser(); fine = fine->coarser())
    levels_.push_back({std::make_shared<Lines>(find_lines(*fine)), nullptr});
}

namespace {

// Shear moduli of the coarser hexahedra as of the linearisation before; at first all alike.
std::vector<double> stiffness_of(const MultigridPlan::Level& level, const Problem& coarser) {
  if (!level.coarser) return std::vector<double>(coarser.mesh().hexes.size());
  const auto moduli = level.coarser->solid().shear_moduli();
  return {moduli.begin(), moduli.end()};
}

// Leaves the next coarser linearisation in `level`, and takes back the memory of the one before first.
Interpolation coarsen(const CoupledSystem& fine, const LinearSettings& settings,
                      MultigridPlan::Level& level) {
  const Problem &problem = fine.problem(), &coarser = *problem.coarser();
  State state = problem.coarsened(fine.state());
  Interpolation P = problem.prolongation().at(state.x, fine.state().x, stiffness_of(level, coarser));
  level.coarser.reset();
  auto projected = std::make_shared<const ProjectedTangent>(fine, P);
  // only the geometry of rigid bodies asks for the residual
  const Residual r = problem.dofs().bodies().empty() ? Residual{} : coarser.residual(state);
  level.coarser = std::make_shared<const CoupledSystem>(
      coarser, settings, std::move(state), r,
      std::vector<std::shared_ptr<const TermTangent>>{std::move(projected)});
  return P;
}

}  // namespace

Multigrid::Multigrid(SharedSystem finest, std::shared_ptr<MultigridPlan> plan,
                     const MultigridSettings& settings, Precision smoothing, const KeepFactors& keep)
    : cycle_(settings.cycle), plan_(std::move(plan)) {
  std::vector<Interpolation> interpolations;
  SharedSystem fine = finest;
  for (auto& level : plan_->levels()) {
    interpolations.push_back(coarsen(*fine, plan_->settings(), level));
    fine = level.coarser;
    coarse_bytes_ += fine->bytes() + fine->problem().solid().bytes() + fine->solid().bytes() +
                     fine->solid().cache_bytes() + fine->problem().mesh().bytes();
  }
  base_ = std::make_unique<ExactBlock>(*fine, plan_->base(), keep);
  fine = std::move(finest);
  for (std::size_t i = 0; i < interpolations.size(); ++i) {
    auto& level = plan_->levels()[i];
    if (!keeps_factors()) level.largest_eigenvalue = 0;
    levels_.push_back(
        std::make_unique<Level>(fine, level, std::move(interpolations[i]), settings, smoothing));
    level.largest_eigenvalue = levels_.back()->smoother->largest_eigenvalue();
    fine = level.coarser;
  }
}

Multigrid::Level::Level(const SharedSystem& fine, MultigridPlan::Level& plan, Interpolation given,
                        const MultigridSettings& settings, Precision smoothing)
    : problem(fine->problem()),
      layout(fine->layout()),
      coarse(plan.coarser),
      P(std::move(given)),
      block(fine),
      jacobi(std::make_shared<LineJacobi>(*fine, plan.lines, matrices_of(smoothing))),
      smoother(make_smoother(fine, jacobi, settings, smoothing, plan.largest_eigenvalue)),
      correction(layout.primal()),
      coarse_residual(coarse->layout().primal()),
      coarse_correction(coarse->layout().primal()),
      coarse_nodal(coarse->state().x.size()) {}

double Multigrid::refresh(SharedSystem system) {
  levels_.front()->block.refresh(system);
  return levels_.front()->smoother->refresh(std::move(system));
}

void Multigrid::release() {
  levels_.front()->block.release();
  levels_.front()->smoother->release();
}

// Tᵀ Pᵀ r without constrained directions, r: what `correction` holds; bodies are the same on both levels.
void Multigrid::Level::restrict_residual() {
  const auto nodal = std::span(correction).first(layout.nodal);
  problem.dofs().project(nodal);
  P.apply_transposed(nodal, coarse_nodal);
  coarse->problem().dofs().reduce(coarse->state(), coarse_nodal, coarse_residual);
  for (int i = 0; i < layout.bodies; ++i)
    coarse_residual[coarse->layout().nodal + i] += correction[layout.nodal + i];
}

void Multigrid::Level::prolong() {
  coarse->problem().dofs().expand(coarse->state(), coarse_correction, coarse_nodal);
  const auto nodal = std::span(correction).first(layout.nodal);
  P.apply(coarse_nodal, nodal);
  problem.dofs().project(nodal);
  for (int i = 0; i < layout.bodies; ++i)
    correction[layout.nodal + i] = coarse_correction[coarse->layout().nodal + i];
}

// The cycle from a level on, as a preconditioner of its block.
class Multigrid::From final : public Preconditioner {
 public:
  From(const Multigrid& multigrid, std::size_t level) : multigrid_(multigrid), level_(level) {}
  int size() const override { return multigrid_.levels_[level_]->block.size(); }
  void apply(std::span<const double> b, std::span<double> x) const override {
    multigrid_.cycle(level_, b, x);
  }
  bool is_linear() const override { return true; }

 private:
  const Multigrid& multigrid_;
  std::size_t level_;
};

void Multigrid::cycle(std::size_t number, std::span<const double> b, std::span<double> x) const {
  if (number == levels_.size()) return base_->apply(b, x);
  Level& level = *levels_[number];
  level.smoother->before(b, x, level.correction);
  level.restrict_residual();
  cycle(number + 1, level.coarse_residual, level.coarse_correction);
  if (number + 1 < levels_.size() && cycle_ == Cycle::w) {
    std::vector<double> residual(level.coarse_residual.size()), correction(residual.size());
    correct(levels_[number + 1]->block, From(*this, number + 1), level.coarse_residual,
            level.coarse_correction, residual, correction);
  }
  level.prolong();
  level.smoother->after(level.correction, x);
}

std::size_t Multigrid::bytes() const {
  std::size_t total = base_->bytes() + coarse_bytes_;
  for (const auto& l : levels_)
    total += l->jacobi->bytes() + l->smoother->bytes() + bytes_of(l->correction) +
             bytes_of(l->coarse_residual) + bytes_of(l->coarse_correction) + bytes_of(l->coarse_nodal) +
             l->P.bytes() + l->problem.prolongation().bytes();
  return total;
}

}  // namespace bulbus::inline precond
