#include "contact/law/block_tangent.hpp"

#include <algorithm>

namespace bulbus::inline contact {

std::span<double> BlockTangent::block(std::span<const int> nodes) {
  const std::size_t k = nodes.size();
  if (places_.empty() || !std::ranges::equal(nodes, std::span(nodes_).subspan(places_.back().node))) {
    places_.push_back({nodes_.size(), values_.size(), k});
    nodes_.insert(nodes_.end(), nodes.begin(), nodes.end());
    values_.resize(values_.size() + 9 * k * k);
  }
  return std::span(values_).subspan(places_.back().value);
}

void BlockTangent::add_action(std::span<const double> dx, std::span<double> force) const {
  visit([&](std::span<const int> nodes, std::span<const double> K) {
    const std::size_t n = 3 * nodes.size();
    for (std::size_t r = 0; r < n; ++r)
      for (std::size_t c = 0; c < n; ++c)
        force[3 * nodes[r / 3] + r % 3] += K[n * r + c] * dx[3 * nodes[c / 3] + c % 3];
  });
}

void BlockTangent::visit(const ContributionVisitor& visitor) const {
  for (const Place& p : places_)
    visitor({&nodes_[p.node], p.nodes}, {&values_[p.value], 9 * p.nodes * p.nodes});
}

}  // namespace bulbus::inline contact
