#pragma once
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "precond/operators/displacement.hpp"

namespace bulbus::inline precond {

/// A displacement, or forces, in single precision: a NodeSingle per local node, ghosts included, and 6
/// numbers per rigid body on rank 0.
struct NodalSingle {
  std::vector<NodeSingle> nodal;
  std::vector<double> bodies;
  explicit NodalSingle(const CoupledSystem& system)
      : nodal(system.problem().mesh().nodes()), bodies(system.layout().bodies) {}
  std::size_t bytes() const { return nodal.capacity() * sizeof(NodeSingle); }
};

/// The augmented displacement block as smoothers apply it: hexahedra by their mean tangents in single
/// precision, what acts on few nodes (terms, liquids' pressures, rigid bodies) as it is.
class SingleBlock final : public TangentBlock {
 public:
  explicit SingleBlock(SharedSystem system);
  int size() const override { return size_; }
  /// On primal vectors; constrained directions are identity rows times constrained_diagonal(). A translation
  /// of everything costs no accuracy. Collective.
  void apply(std::span<const double> x, std::span<double> y) const override;

  /// Workspace: a displacement and the forces that answer it; these are zero between uses.
  NodalSingle& d() const { return d_; }
  NodalSingle& z() const { return z_; }
  /// z += A d on owned nodes and bodies, where d has free directions only: its ghosts and its nodes of bodies
  /// are set here. Collective.
  void apply() const;
  /// z += A x of a primal vector without constrained directions. d is used. Collective.
  void apply_to(std::span<const double> x) const;

  void refresh(SharedSystem system) override;
  void release() override { system_.reset(); }
  const CoupledSystem& system() const { return *system_; }
  std::size_t bytes() const;

 private:
  void act(std::span<const double> dx) const;

  int size_;
  SharedSystem system_;
  const DofMap& dofs_;
  int free_ = 0;  // the first owned node no direction of which is constrained; behind them if there is none
  std::vector<int> touched_;  // local nodes that not only hexahedra act on
  mutable NodalSingle d_, z_;
};

}  // namespace bulbus::inline precond
