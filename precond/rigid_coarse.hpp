#pragma once
#include <Eigen/Dense>

#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_operator.hpp"
#include "precond/boomeramg.hpp"

namespace bulbus {

/// Galerkin correction on the rigid motions of aggregates in the current configuration: the bending and tilting that scalar AMG
/// cannot see. x = Z (Zᵀ A Z)⁻¹ Zᵀ b, the coarse matrix accumulated contribution by contribution and factorised densely; it may
/// be indefinite. Rigid bodies are coarse unknowns as they are.
class RigidCoarse final : public Preconditioner {
 public:
  /// Collective.
  RigidCoarse(const CoupledSystem& system, const std::array<DistributedCsr, 3>& scalar, int aggregates);
  int size() const override { return system_.layout().primal(); }
  void apply(std::span<const double> b, std::span<double> x) const override;
  bool fixed() const override { return true; }
  std::size_t bytes() const override;
  int coarse_size() const { return static_cast<int>(factor_.rows()); }

 private:
  struct Aggregate {
    Vec3<double> center;
    double inverse_radius;
    Eigen::Matrix<double, 6, 6> basis;  // columns: orthonormal combinations of the six modes; zero where deficient
  };
  using Modes = Eigen::Matrix<double, 3, 6>;
  Modes modes(int node) const;  // of a local node, in its aggregate's basis
  Modes plain_modes(int node) const;
  void find_bases();
  Eigen::MatrixXd coarse_matrix() const;

  const CoupledSystem& system_;
  std::vector<int> of_;  // global aggregate of every local node, -1 for none
  std::vector<Aggregate> aggregates_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
};

}  // namespace bulbus
