#pragma once
#include <functional>
#include <span>
#include <vector>

#include "core/element/contribution.hpp"

namespace bulbus::inline element {

/// Matrix of 3×3 blocks between the local nodes of one rank, gathered from small dense contributions: the
/// assembled counterpart of the tangent that is applied on the fly.
class BlockCsr {
 public:
  /// `visit` is called twice (pattern, values) and must hand over the same contributions.
  BlockCsr(int nodes, const std::function<void(const ContributionVisitor&)>& visit);

  /// y += A x, 3 numbers per node.
  void apply(std::span<const double> x, std::span<double> y) const;
  std::size_t nonzeros() const { return 9 * columns_.size(); }
  std::size_t bytes() const;
  std::span<const int> starts() const { return start_; }
  std::span<const int> columns() const { return columns_; }
  /// 9 per block, by columns; one number more at the end.
  std::span<const double> values() const { return values_; }

 private:
  std::vector<int> start_, columns_;
  std::vector<double> values_;
};

}  // namespace bulbus::inline element
