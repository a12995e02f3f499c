#include "precond/operators/projected_tangent.hpp"

#include <algorithm>

namespace bulbus::inline precond {

ProjectedTangent::ProjectedTangent(const CoupledSystem& finer, const Interpolation& P) {
  // Blocks before those of one pair are added up: of 80 bytes, 84 MB. Fewer are sorted more often.
  constexpr std::size_t most = 1 << 20;
  std::size_t limit = most;
  finer.visit_added([&](std::span<const int> nodes, std::span<const double> K) {
    const std::size_t n = nodes.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const auto rows = P.stencil(nodes[i]), columns = P.stencil(nodes[j]);
        for (std::size_t a = 0; a < rows.nodes.size(); ++a)
          for (std::size_t b = 0; b < columns.nodes.size(); ++b) {
            Block& block = blocks_.emplace_back(Block{{rows.nodes[a], columns.nodes[b]}, {}});
            const double weight = rows.weights[a] * columns.weights[b];
            for (int r = 0; r < 3; ++r)
              for (int c = 0; c < 3; ++c)
                block.values[3 * r + c] = weight * K[(3 * i + r) * 3 * n + 3 * j + c];
          }
      }
    if (blocks_.size() < limit) return;
    add_up();
    limit = blocks_.size() + most;
  });
  add_up();
}

// Blocks of the same pair become one.
void ProjectedTangent::add_up() {
  std::ranges::stable_sort(blocks_, {}, &Block::nodes);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    if (kept > 0 && blocks_[kept - 1].nodes == blocks_[k].nodes)
      for (int i = 0; i < 9; ++i) blocks_[kept - 1].values[i] += blocks_[k].values[i];
    else
      blocks_[kept++] = blocks_[k];
  }
  blocks_.resize(kept);
}

void ProjectedTangent::add_action(std::span<const double> dx, std::span<double> force) const {
  for (const auto& [nodes, block] : blocks_)
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) force[3 * nodes[0] + r] += block[3 * r + c] * dx[3 * nodes[1] + c];
}

void ProjectedTangent::visit(const ContributionVisitor& visitor) const {
  std::array<double, 36> pair{};
  for (const auto& [nodes, block] : blocks_) {
    if (nodes[0] == nodes[1]) {
      visitor(std::span(nodes).first(1), block);
      continue;
    }
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) pair[6 * r + 3 + c] = block[3 * r + c];
    visitor(nodes, pair);
  }
}

}  // namespace bulbus::inline precond
