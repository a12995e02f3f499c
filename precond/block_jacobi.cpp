#include "precond/block_jacobi.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "core/base/memory.hpp"

namespace bulbus {
namespace {

// Inverse of a symmetric block, or of its diagonal's magnitude where it is not positive definite.
template <int N>
Eigen::Matrix<double, N, N> safe_inverse(const Eigen::Matrix<double, N, N>& given) {
  const Eigen::Matrix<double, N, N> block = 0.5 * (given + given.transpose());
  const Eigen::LLT<Eigen::Matrix<double, N, N>> factor(block);
  if (factor.info() == Eigen::Success) return factor.solve(Eigen::Matrix<double, N, N>::Identity());
  const double mean = block.diagonal().cwiseAbs().mean();
  return block.diagonal().cwiseAbs().cwiseMax(1e-3 * mean + 1e-300).cwiseInverse().asDiagonal();
}

}  // namespace

BlockJacobi::BlockJacobi(const CoupledSystem& system) : size_(system.layout().primal()), nodal_(system.layout().nodal) {
  const auto& blocks = system.nodal_blocks();
  nodes_.reserve(2 * nodal_);
  for (int n = 0; n < nodal_ / 3; ++n) {
    const Eigen::Matrix3d inverse = safe_inverse<3>(Eigen::Map<const Eigen::Matrix3d>(&blocks[9 * n]));
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) nodes_.push_back(static_cast<float>(inverse(i, j)));
  }
  if (system.layout().bodies > 0)
    for (const auto& block : system.body_blocks()) {
      const auto inverse = safe_inverse<6>(Eigen::Map<const Eigen::Matrix<double, 6, 6>>(block.data()));
      bodies_.insert(bodies_.end(), inverse.data(), inverse.data() + 36);
    }
}

void BlockJacobi::apply(std::span<const double> x, std::span<double> y) const {
  for (int n = 0; n < nodal_ / 3; ++n) {
    const float* b = &nodes_[6 * static_cast<std::size_t>(n)];
    const double p = x[3 * n], q = x[3 * n + 1], r = x[3 * n + 2];
    y[3 * n] = b[0] * p + b[1] * q + b[2] * r;
    y[3 * n + 1] = b[1] * p + b[3] * q + b[4] * r;
    y[3 * n + 2] = b[2] * p + b[4] * q + b[5] * r;
  }
  for (std::size_t k = 0; k < bodies_.size() / 6; ++k) {
    const std::size_t body = nodal_ + 6 * (k / 6);
    double sum = 0;
    for (int j = 0; j < 6; ++j) sum += bodies_[6 * k + j] * x[body + j];
    y[nodal_ + k] = sum;
  }
}

std::size_t BlockJacobi::bytes() const { return bytes_of(nodes_) + bytes_of(bodies_); }

}  // namespace bulbus
