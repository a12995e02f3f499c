#include "precond/operators/displacement.hpp"

#include <algorithm>
#include <limits>

#include "core/base/error.hpp"
#include "core/solve/reduced.hpp"
#include "precond/amg/assembled.hpp"
#include "precond/amg/hybrid.hpp"
#include "precond/amg/scalar_amg.hpp"
#include "precond/amg/scalar_matrices.hpp"
#include "precond/coarse/aggregation.hpp"
#include "precond/coarse/multigrid.hpp"
#include "precond/operators/single_block.hpp"
#include "precond/smoothers/block_jacobi.hpp"

namespace bulbus::inline precond {
namespace {

// The three scalar AMGs alone, with the blocks that they need for bodies.
class ScalarAmgAlone final : public DisplacementPreconditioner {
 public:
  explicit ScalarAmgAlone(const CoupledSystem& system)
      : jacobi_(system), amg_(system, scalar_matrices(system), jacobi_) {}
  int size() const override { return amg_.size(); }
  void apply(std::span<const double> x, std::span<double> y) const override { amg_.apply(x, y); }
  bool is_linear() const override { return true; }
  std::size_t bytes() const override { return jacobi_.bytes() + amg_.bytes(); }

 private:
  BlockJacobi jacobi_;
  ScalarAmg amg_;
};

// Floats hold a displacement to 6e-8: a contact much stiffer than the hexahedra around it would make noise of
// what they feel, 6e-4 of it where they have 1e-4 of a node's stiffness (docs/decisions/006).
Precision fitting_precision(const CoupledSystem& system, const LinearSettings& settings) {
  constexpr double most = 1 - 1e-4;  // of a node's stiffness
  const Problem& problem = system.problem();
  std::vector<double> stiffness(system.state().x.size());
  system.visit_surface([&](std::span<const int> nodes, std::span<const double> K) {
    for (std::size_t i = 0; i < 3 * nodes.size(); ++i)
      stiffness[3 * nodes[i / 3] + i % 3] += K[i * (3 * nodes.size() + 1)];
  });
  problem.mesh().halo.accumulate_ghosts(stiffness);
  double part = 0;
  for (int i = 0; i < system.layout().nodal; ++i)
    part = std::max(part, stiffness[i] * system.scaling()[i] * system.scaling()[i]);
  return problem.comm().max(part) > most ? Precision::full : settings.smoothing;
}

}  // namespace

std::unique_ptr<TangentBlock> displacement_block(SharedSystem system, Precision precision) {
  if (precision == Precision::single) return std::make_unique<SingleBlock>(std::move(system));
  return std::make_unique<DisplacementBlock>(std::move(system));
}

struct DisplacementFactory::Plans {
  const Problem* problem;
  std::shared_ptr<MultigridPlan> multigrid;
  std::shared_ptr<AggregationPlan> aggregation;
  std::shared_ptr<RigidPlan> rigid;
};

DisplacementFactory::DisplacementFactory(const LinearSettings& settings) : settings_(settings) {}
DisplacementFactory::~DisplacementFactory() = default;

std::unique_ptr<DisplacementPreconditioner> DisplacementFactory::make(SharedSystem system,
                                                                      const KeepFactors& keep) {
  const Problem& problem = system->problem();
  if (!plans_ || plans_->problem != &problem) plans_ = std::make_unique<Plans>(&problem);
  const Displacement name = settings_.displacement_on(problem.coarser());
  const Precision smoothing = fitting_precision(*system, settings_);
  if (name == Displacement::jacobi) return std::make_unique<BlockJacobi>(*system);
  if (name == Displacement::scalar_amg) return std::make_unique<ScalarAmgAlone>(*system);
  if (name == Displacement::boomeramg || name == Displacement::boomeramg_nodal)
    return std::make_unique<AssembledAmg>(*system, name == Displacement::boomeramg_nodal);
  if (name == Displacement::exact) return std::make_unique<ExactBlock>(*system);
  if (name == Displacement::multigrid) {
    if (!problem.coarser())
      throw scene_error("solver.linear.displacement", "multigrid needs a refined mesh",
                        "Give mesh.refine, or take 'aggregation'.");
    if (!plans_->multigrid) plans_->multigrid = std::make_shared<MultigridPlan>(problem, settings_);
    return std::make_unique<Multigrid>(system, plans_->multigrid, settings_.multigrid, smoothing, keep);
  }
  if (name == Displacement::hybrid) {
    const int nodes = settings_.aggregates > 0
                          ? std::max(8, static_cast<int>(problem.mesh().all_nodes / settings_.aggregates))
                          : 0;
    if (nodes > 0 && !(plans_->rigid && plans_->rigid->fits(problem, smoothing)))
      plans_->rigid = std::make_shared<RigidPlan>(*system, nodes, smoothing, std::numeric_limits<int>::max());
    return std::make_unique<Hybrid>(system, settings_.degree, settings_.smoothing_range, plans_->rigid,
                                    smoothing);
  }
  if (!plans_->aggregation || !plans_->aggregation->rigid->fits(problem, smoothing))
    plans_->aggregation = std::make_shared<AggregationPlan>(*system, settings_.aggregation, smoothing);
  return std::make_unique<Aggregation>(system, plans_->aggregation, settings_.aggregation, smoothing, keep);
}

void DisplacementFactory::factorise_coarse() {
  settings_.aggregation.factorised = std::numeric_limits<int>::max();
  if (plans_ && plans_->aggregation) plans_->aggregation->rigid->levels.reset();
}

}  // namespace bulbus::inline precond
