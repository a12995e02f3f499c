#include "precond/smoothers/block_jacobi.hpp"

#include <cmath>

#include "core/base/memory.hpp"

namespace bulbus::inline precond {

BodyBlocks::BodyBlocks(const CoupledSystem& system) {
  if (system.layout().bodies == 0) return;
  for (const auto& block : system.body_blocks()) {
    const auto inverse = safe_inverse<6>(Eigen::Map<const Eigen::Matrix<double, 6, 6>>(block.data()));
    inverse_.insert(inverse_.end(), inverse.data(), inverse.data() + 36);
  }
}

void BodyBlocks::apply(std::span<const double> x, std::span<double> y) const {
  for (std::size_t k = 0; k < inverse_.size() / 6; ++k) {
    double sum = 0;
    for (int j = 0; j < 6; ++j) sum += inverse_[6 * k + j] * x[k / 6 * 6 + j];
    y[k] = sum;
  }
}

std::size_t BodyBlocks::bytes() const { return bytes_of(inverse_); }

BlockJacobi::BlockJacobi(const CoupledSystem& system)
    : size_(system.layout().primal()), nodal_(system.layout().nodal), bodies_(system) {
  const auto blocks = system.nodal_blocks();
  nodes_.reserve(2 * nodal_);
  for (int n = 0; n < nodal_ / 3; ++n) {
    const Eigen::Matrix3d inverse = safe_inverse<3>(Eigen::Map<const Eigen::Matrix3d>(&blocks[9 * n]));
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) nodes_.push_back(static_cast<float>(inverse(i, j)));
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
  bodies_.apply(x.subspan(nodal_), y.subspan(nodal_));
}

std::size_t BlockJacobi::bytes() const { return bytes_of(nodes_) + bodies_.bytes(); }

}  // namespace bulbus::inline precond
