#include "core/element/block_csr.hpp"

#include <algorithm>
#include <cstring>

#include "core/base/memory.hpp"

namespace bulbus::inline element {

BlockCsr::BlockCsr(int nodes, const std::function<void(const ContributionVisitor&)>& visit)
    : start_(nodes + 1) {
  std::vector<std::vector<int>> neighbours(nodes);
  visit([&](std::span<const int> n, std::span<const double>) {
    for (int a : n)
      for (int b : n) {
        auto& row = neighbours[a];
        if (const auto at = std::lower_bound(row.begin(), row.end(), b); at == row.end() || *at != b)
          row.insert(at, b);
      }
  });
  for (int n = 0; n < nodes; ++n) {
    columns_.insert(columns_.end(), neighbours[n].begin(), neighbours[n].end());
    start_[n + 1] = static_cast<int>(columns_.size());
    std::vector<int>().swap(neighbours[n]);
  }
  columns_.shrink_to_fit();
  values_.resize(9 * columns_.size() +
                 1);  // one more, as the last column of a block is loaded with what follows it
  visit([&](std::span<const int> n, std::span<const double> K) {
    const std::size_t width = 3 * n.size();
    for (std::size_t a = 0; a < n.size(); ++a)
      for (std::size_t b = 0; b < n.size(); ++b) {
        const auto first = columns_.begin() + start_[n[a]], last = columns_.begin() + start_[n[a] + 1];
        double* block = values_.data() + 9 * (std::lower_bound(first, last, n[b]) - columns_.begin());
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) block[3 * j + i] += K[(3 * a + i) * width + 3 * b + j];
      }
  });
}

// A column of a block is three of four numbers loaded; the fourth sum is dropped. Two sets of sums hide the
// latency of the adds, and the matrix, read once, is fetched well ahead.
void BlockCsr::apply(std::span<const double> x, std::span<double> y) const {
  using Four = double __attribute__((vector_size(4 * sizeof(double))));
  constexpr int ahead = 288;  // numbers
  const int nodes = static_cast<int>(start_.size()) - 1;
  const auto add = [&](int k, Four& sum, Four& other) {
    const double* A = values_.data() + 9 * static_cast<std::size_t>(k);
    const double* v = x.data() + 3 * static_cast<std::size_t>(columns_[k]);
    Four a, b, c;
    std::memcpy(&a, A, sizeof a), std::memcpy(&b, A + 3, sizeof b), std::memcpy(&c, A + 6, sizeof c);
    __builtin_prefetch(A + ahead, 0, 0);
    sum += a * v[0];
    other += b * v[1];
    sum += c * v[2];
  };
  for (int n = 0; n < nodes; ++n) {
    Four even{}, odd{};
    int k = start_[n];
    for (; k + 1 < start_[n + 1]; k += 2) add(k, even, odd), add(k + 1, odd, even);
    if (k < start_[n + 1]) add(k, even, odd);
    const Four sum = even + odd;
    for (int c = 0; c < 3; ++c) y[3 * n + c] += sum[c];
  }
}

std::size_t BlockCsr::bytes() const { return bytes_of(start_) + bytes_of(columns_) + bytes_of(values_); }

}  // namespace bulbus::inline element
