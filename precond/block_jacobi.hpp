#pragma once
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "core/solve/linear_operator.hpp"

namespace bulbus {

/// Inverses of the 3×3 blocks of the nodes and of the 6×6 blocks of rigid bodies. A block that is not positive definite is
/// replaced by its diagonal's magnitude, so that the result is symmetric positive.
class BlockJacobi final : public Preconditioner {
 public:
  explicit BlockJacobi(const CoupledSystem& system);
  int size() const override { return size_; }
  void apply(std::span<const double> x, std::span<double> y) const override;
  bool fixed() const override { return true; }
  std::size_t bytes() const override;

 private:
  int size_, nodal_;
  std::vector<float> nodes_;    // upper triangle: 6 per node
  std::vector<double> bodies_;  // 36 per body, on rank 0
};

}  // namespace bulbus
