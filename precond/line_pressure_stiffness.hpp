#pragma once
#include <array>
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "precond/line_jacobi.hpp"

namespace bulbus {

/// K = Bᵀ L⁻¹ B on element pressures, one number per hexahedron of this rank; L: the displacement block's parts on lines, with rigid
/// bodies at rest. B is stored in single precision, so that a motion of a whole hexahedron still does not change its volume.
class LinePressureStiffness final : public LinearOperator {
 public:
  LinePressureStiffness(const CoupledSystem& system, const LineJacobi& lines);
  int size() const override { return static_cast<int>(b_.size()); }
  /// Collective.
  void apply(std::span<const double> p, std::span<double> q) const override;
  /// ∂V_e/∂u at a corner, as it is stored.
  Eigen::Vector3f constraint(int hex, int corner) const;
  std::size_t bytes() const;

 private:
  // x y z of a node and nothing
  using Four = double __attribute__((vector_size(32)));
  using FourSingle = float __attribute__((vector_size(16)));
  std::span<double> numbers() const { return {reinterpret_cast<double*>(nodal_.data()), 4 * nodal_.size()}; }

  const LocalMesh& mesh_;
  const LineJacobi& lines_;
  std::vector<std::array<FourSingle, 7>> b_;  // of nodes 1 to 7; that of node 0 is minus their sum
  std::vector<std::pair<int, Mat3<double>>> held_;  // owned nodes and their projectors
  mutable std::vector<Four> nodal_;
};

}  // namespace bulbus
