#pragma once
#include <span>
#include <vector>

#include "core/problem/term.hpp"

namespace bulbus::inline contact {

/// A tangent as a list of small dense blocks, each with its local nodes, three rows per node.
class BlockTangent {
 public:
  /// The block of these nodes, to be added to: 3k × 3k by rows, zeros at first. The last one again if the
  /// nodes are the same.
  std::span<double> block(std::span<const int> nodes);
  void add_action(std::span<const double> dx, std::span<double> force) const;
  void visit(const ContributionVisitor& visitor) const;

 private:
  struct Place {
    std::size_t node, value, nodes;
  };
  std::vector<Place> places_;
  std::vector<int> nodes_;
  std::vector<double> values_;
};

}  // namespace bulbus::inline contact
