#include "core/element/block_csr.hpp"

#include <algorithm>

#include "core/base/memory.hpp"

namespace bulbus {

BlockCsr::BlockCsr(int nodes, const std::function<void(const ContributionVisitor&)>& visit) : start_(nodes + 1) {
  std::vector<std::vector<int>> neighbours(nodes);
  visit([&](std::span<const int> n, std::span<const double>) {
    for (int a : n)
      for (int b : n) {
        auto& row = neighbours[a];
        if (const auto at = std::lower_bound(row.begin(), row.end(), b); at == row.end() || *at != b) row.insert(at, b);
      }
  });
  for (int n = 0; n < nodes; ++n) {
    columns_.insert(columns_.end(), neighbours[n].begin(), neighbours[n].end());
    start_[n + 1] = static_cast<int>(columns_.size());
    std::vector<int>().swap(neighbours[n]);
  }
  values_.resize(9 * columns_.size());
  visit([&](std::span<const int> n, std::span<const double> K) {
    const std::size_t width = 3 * n.size();
    for (std::size_t a = 0; a < n.size(); ++a)
      for (std::size_t b = 0; b < n.size(); ++b) {
        const auto first = columns_.begin() + start_[n[a]], last = columns_.begin() + start_[n[a] + 1];
        double* block = values_.data() + 9 * (std::lower_bound(first, last, n[b]) - columns_.begin());
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) block[3 * i + j] += K[(3 * a + i) * width + 3 * b + j];
      }
  });
}

void BlockCsr::apply(std::span<const double> x, std::span<double> y) const {
  const int nodes = static_cast<int>(start_.size()) - 1;
  for (int n = 0; n < nodes; ++n) {
    double s0 = 0, s1 = 0, s2 = 0;
    for (int k = start_[n]; k < start_[n + 1]; ++k) {
      const double* A = values_.data() + 9 * static_cast<std::size_t>(k);
      const double* v = x.data() + 3 * static_cast<std::size_t>(columns_[k]);
      s0 += A[0] * v[0] + A[1] * v[1] + A[2] * v[2];
      s1 += A[3] * v[0] + A[4] * v[1] + A[5] * v[2];
      s2 += A[6] * v[0] + A[7] * v[1] + A[8] * v[2];
    }
    y[3 * n] += s0, y[3 * n + 1] += s1, y[3 * n + 2] += s2;
  }
}

std::size_t BlockCsr::bytes() const { return bytes_of(start_) + bytes_of(columns_) + bytes_of(values_); }

}  // namespace bulbus
