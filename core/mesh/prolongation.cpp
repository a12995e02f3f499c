#include "core/mesh/prolongation.hpp"

#include <algorithm>

#include "core/base/memory.hpp"

namespace bulbus {

Prolongation::Prolongation(const RefinedMesh& refinement, const LocalMesh& coarse, const LocalMesh& fine)
    : owned_(fine.owned), coarse_owned_(coarse.owned), coarse_halo_(coarse.halo), start_{0}, same_(coarse.owned) {
  std::vector<int> local(refinement.coarse_nodes, -1);
  for (int n = 0; n < coarse.nodes(); ++n) local[coarse.input_node[n]] = n;
  for (int n = 0; n < fine.nodes(); ++n) {
    auto parents = refinement.parents_of(fine.input_node[n]);
    for (int& p : parents) p = local[p];
    if (std::ranges::find(parents, -1) == parents.end()) parents_.insert(parents_.end(), parents.begin(), parents.end());
    start_.push_back(static_cast<int>(parents_.size()));
    if (parents.size() == 1 && parents[0] >= 0 && parents[0] < coarse.owned) same_[parents[0]] = n;
  }
  parents_.shrink_to_fit();
}

std::span<const int> Prolongation::parents(int node) const {
  return {parents_.data() + start_[node], parents_.data() + start_[node + 1]};
}

void Prolongation::interpolate(std::span<const double> coarse, std::span<double> fine) const {
  for (int n = 0; n < owned_; ++n) {
    double sum[3] = {};
    const auto from = parents(n);
    for (int p : from)
      for (int c = 0; c < 3; ++c) sum[c] += coarse[3 * p + c];
    for (int c = 0; c < 3; ++c) fine[3 * n + c] = sum[c] / static_cast<double>(from.size());
  }
}

void Prolongation::restricted(std::span<const double> fine, std::span<double> coarse) const {
  std::fill(coarse.begin(), coarse.end(), 0.0);
  for (int n = 0; n < owned_; ++n) {
    const auto to = parents(n);
    for (int p : to)
      for (int c = 0; c < 3; ++c) coarse[3 * p + c] += fine[3 * n + c] / static_cast<double>(to.size());
  }
  coarse_halo_.fold(coarse);
}

void Prolongation::inject(std::span<const double> fine, std::span<double> coarse) const {
  for (int n = 0; n < coarse_owned_; ++n)
    for (int c = 0; c < 3; ++c) coarse[3 * n + c] = fine[3 * same_[n] + c];
  coarse_halo_.update(coarse);
}

std::size_t Prolongation::bytes() const { return bytes_of(start_) + bytes_of(parents_) + bytes_of(same_); }

}  // namespace bulbus
