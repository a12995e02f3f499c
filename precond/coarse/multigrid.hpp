#pragma once
#include <memory>
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "core/solve/mumps.hpp"
#include "core/solve/settings.hpp"
#include "precond/operators/displacement.hpp"
#include "precond/smoothers/line_jacobi.hpp"
#include "precond/smoothers/smoother.hpp"

namespace bulbus::inline precond {

/// What multigrid keeps from one linearisation to the next: the lines of every refined level, the base
/// matrix's analysis, and as long as its factors are kept the smoothers' largest eigenvalues: what changes
/// these changes the matrix, too.
class MultigridPlan {
 public:
  /// `settings`: of the coarser systems, too. Collective.
  MultigridPlan(const Problem& finest, const LinearSettings& settings);

  struct Level {
    std::shared_ptr<const Lines> lines;
    SharedSystem coarser;  ///< the last linearisation on the next coarser mesh; null before the first
    double largest_eigenvalue = 0;  ///< of the smoother
  };
  const LinearSettings& settings() const { return settings_; }
  std::vector<Level>& levels() { return levels_; }
  /// Of the base level.
  std::shared_ptr<Mumps> base() const { return base_; }

 private:
  LinearSettings settings_;
  std::vector<Level> levels_;  // finest first; without the base
  std::shared_ptr<Mumps> base_;
};

/// Geometric multigrid on the meshes that the problem's mesh refines: V(1,1) or W(1,1), every refined level
/// applied on the fly and rediscretised in the injected state, smoothed by Chebyshev with line Jacobi; the
/// base mesh is solved directly. A fixed linear map, symmetric.
class Multigrid final : public DisplacementPreconditioner {
 public:
  /// Linearises the coarser problems, too. Collective.
  Multigrid(SharedSystem finest, std::shared_ptr<MultigridPlan> plan, const MultigridSettings& settings,
            Precision smoothing = Precision::single, const KeepFactors& keep = {});
  int size() const override { return levels_.front()->layout.primal(); }
  void apply(std::span<const double> b, std::span<double> x) const override { cycle(0, b, x); }
  bool is_linear() const override { return true; }
  /// Of the finest level; the coarser ones stay.
  double refresh(SharedSystem system) override;
  void release() override;
  bool keeps_factors() const override { return base_->keeps_factors(); }
  std::string setup_error() const override { return base_->setup_error(); }
  std::size_t bytes() const override;
  /// Of the finest level.
  std::shared_ptr<const LineJacobi> lines() const override { return levels_.front()->jacobi; }

 private:
  struct Level {
    Level(const SharedSystem& fine, MultigridPlan::Level& plan, Interpolation P,
          const MultigridSettings& settings, Precision smoothing);
    void restrict_residual();
    void prolong();

    const Problem& problem;
    Layout layout;
    SharedSystem coarse;
    Interpolation P;
    DisplacementBlock block;
    std::shared_ptr<const LineJacobi> jacobi;
    std::unique_ptr<Smoother> smoother;
    std::vector<double> correction, coarse_residual, coarse_correction, coarse_nodal;
  };
  class From;
  void cycle(std::size_t level, std::span<const double> b, std::span<double> x) const;

  Cycle cycle_;
  std::shared_ptr<MultigridPlan> plan_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::unique_ptr<DisplacementPreconditioner> base_;
  std::size_t coarse_bytes_ = 0;
};

}  // namespace bulbus::inline precond
