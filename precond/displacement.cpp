#include "precond/displacement.hpp"

#include <optional>

#include "core/base/error.hpp"
#include "precond/aggregation.hpp"
#include "precond/assembled.hpp"
#include "precond/block_jacobi.hpp"
#include "precond/hybrid.hpp"
#include "precond/multigrid.hpp"
#include "precond/scalar_amg.hpp"
#include "precond/scalar_matrices.hpp"

namespace bulbus {
namespace {

// The three scalar AMGs alone, with the blocks that they need for bodies.
class ScalarAmgAlone final : public Preconditioner {
 public:
  explicit ScalarAmgAlone(const CoupledSystem& system) : jacobi_(system), amg_(system, scalar_matrices(system), jacobi_) {}
  int size() const override { return amg_.size(); }
  void apply(std::span<const double> x, std::span<double> y) const override { amg_.apply(x, y); }
  bool fixed() const override { return true; }
  std::size_t bytes() const override { return jacobi_.bytes() + amg_.bytes(); }

 private:
  BlockJacobi jacobi_;
  ScalarAmg amg_;
};

template <class P>
DisplacementInverse with_lines(std::unique_ptr<P> inverse) {
  const LineJacobi* lines = &inverse->lines();
  return {std::move(inverse), lines};
}

}  // namespace

std::string chosen_displacement(const LinearSettings& settings, const Problem& problem) {
  if (settings.displacement != "auto") return settings.displacement;
  return problem.coarser() ? "multigrid" : "aggregation";
}

Precision chosen_precision(const LinearSettings& settings) { return settings.smoothing == "double" ? Precision::full : Precision::single; }

struct DisplacementFactory::Plans {
  const Problem* problem;
  std::optional<MultigridPlan> multigrid;
  std::optional<AggregationPlan> aggregation;
  std::optional<RigidPlan> rigid;
};

DisplacementFactory::DisplacementFactory(const LinearSettings& settings) : settings_(settings) {}
DisplacementFactory::~DisplacementFactory() = default;

DisplacementInverse DisplacementFactory::make(const CoupledSystem& system) {
  const Problem& problem = system.problem();
  if (!plans_ || plans_->problem != &problem) plans_ = std::make_unique<Plans>(&problem);
  const std::string name = chosen_displacement(settings_, problem);
  const Precision smoothing = chosen_precision(settings_);
  if (name == "jacobi") return {std::make_unique<BlockJacobi>(system)};
  if (name == "scalar_amg") return {std::make_unique<ScalarAmgAlone>(system)};
  if (name == "boomeramg" || name == "boomeramg_nodal") return {std::make_unique<AssembledAmg>(system, name == "boomeramg_nodal")};
  if (name == "exact") return {std::make_unique<ExactBlock>(system)};
  if (name == "multigrid") {
    if (!problem.coarser())
      throw scene_error("solver.linear.displacement", "multigrid needs a refined mesh", "Give mesh.refine, or take 'aggregation'.");
    if (!plans_->multigrid) plans_->multigrid.emplace(problem, settings_);
    return with_lines(std::make_unique<Multigrid>(system, *plans_->multigrid, settings_.multigrid, smoothing));
  }
  if (name == "hybrid") {
    const int nodes = settings_.aggregates > 0 ? std::max(8, static_cast<int>(problem.mesh().all_nodes / settings_.aggregates)) : 0;
    if (nodes > 0 && !plans_->rigid) plans_->rigid.emplace(system, nodes, smoothing);
    return {std::make_unique<Hybrid>(system, settings_.degree, settings_.smoothed_part, plans_->rigid ? &*plans_->rigid : nullptr, smoothing)};
  }
  if (!plans_->aggregation) plans_->aggregation.emplace(system, settings_.aggregation.nodes, smoothing);
  return with_lines(std::make_unique<Aggregation>(system, *plans_->aggregation, settings_.aggregation, smoothing));
}

}  // namespace bulbus
