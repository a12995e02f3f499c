#pragma once
#include <memory>
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "precond/smoothers/line_jacobi.hpp"

namespace bulbus::inline precond {

/// K = Bᵀ L⁻¹ B on element pressures, one number per hexahedron of this rank; L: the displacement block's
/// parts on lines, with rigid bodies at rest. In single precision, in which a motion of a whole hexahedron
/// still does not change its volume.
class LinePressureStiffness final : public LinearOperator {
 public:
  LinePressureStiffness(SharedSystem system, std::shared_ptr<const LineJacobi> lines);
  int size() const override { return static_cast<int>(problem_.mesh().hexes.size()); }
  /// Collective.
  void apply(std::span<const double> p, std::span<double> q) const override;
  /// B is that of another linearisation from now on, L stays.
  void refresh(SharedSystem system) { system_ = std::move(system); }
  /// Gives the linearisation up; of no use until it is refreshed.
  void release() { system_.reset(); }
  std::size_t bytes() const;

 private:
  const Problem& problem_;
  SharedSystem system_;
  std::shared_ptr<const LineJacobi> lines_;
  mutable std::vector<NodeSingle> nodal_;
};

}  // namespace bulbus::inline precond
