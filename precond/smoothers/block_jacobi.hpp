#pragma once
#include <Eigen/Dense>
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "precond/operators/displacement_preconditioner.hpp"

namespace bulbus::inline precond {

/// Inverse of a symmetric block (N may be Eigen::Dynamic), or of its diagonal's magnitude where it is
/// not positive definite.
template <int N>
Eigen::Matrix<double, N, N> safe_inverse(const Eigen::Matrix<double, N, N>& given) {
  const Eigen::Matrix<double, N, N> block = 0.5 * (given + given.transpose());
  const Eigen::LLT<Eigen::Matrix<double, N, N>> factor(block);
  if (factor.info() == Eigen::Success)
    return factor.solve(Eigen::Matrix<double, N, N>::Identity(block.rows(), block.rows()));
  const double mean = block.diagonal().cwiseAbs().mean();
  return block.diagonal().cwiseAbs().cwiseMax(1e-3 * mean + 1e-300).cwiseInverse().asDiagonal();
}

/// Inverses of the 6×6 blocks of rigid bodies, on rank 0.
class BodyBlocks {
 public:
  explicit BodyBlocks(const CoupledSystem& system);
  /// Of the bodies' parts of primal vectors.
  void apply(std::span<const double> x, std::span<double> y) const;
  std::size_t bytes() const;

 private:
  std::vector<double> inverse_;  // 36 per body
};

/// Inverses of the 3×3 blocks of the nodes and of the 6×6 blocks of rigid bodies. A block that is not
/// positive definite is replaced by its diagonal's magnitude, so that the result is symmetric positive.
class BlockJacobi final : public DisplacementPreconditioner {
 public:
  /// Collective.
  explicit BlockJacobi(const CoupledSystem& system);
  int size() const override { return size_; }
  void apply(std::span<const double> x, std::span<double> y) const override;
  bool is_linear() const override { return true; }
  std::size_t bytes() const override;

 private:
  int size_, nodal_;
  std::vector<float> nodes_;  // upper triangle: 6 per node
  BodyBlocks bodies_;
};

}  // namespace bulbus::inline precond
