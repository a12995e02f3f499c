#pragma once
#include <algorithm>
#include <span>
#include <vector>

#include "core/base/memory.hpp"
#include "core/element/contribution.hpp"

namespace bulbus::bench {

/// Compressed rows of single numbers: what a general sparse library would store.
class ScalarCsr {
 public:
  ScalarCsr(int nodes, const std::function<void(const ContributionVisitor&)>& visit) : start_(3 * nodes + 1) {
    std::vector<std::vector<int>> rows(nodes);
    visit([&](std::span<const int> n, std::span<const double>) {
      for (int a : n)
        for (int b : n)
          if (const auto at = std::lower_bound(rows[a].begin(), rows[a].end(), b);
              at == rows[a].end() || *at != b)
            rows[a].insert(at, b);
    });
    for (int r = 0; r < 3 * nodes; ++r) {
      for (int b : rows[r / 3])
        for (int c = 0; c < 3; ++c) columns_.push_back(3 * b + c);
      start_[r + 1] = static_cast<int>(columns_.size());
    }
    columns_.shrink_to_fit();
    values_.resize(columns_.size());
    visit([&](std::span<const int> n, std::span<const double> K) {
      const std::size_t width = 3 * n.size();
      for (std::size_t i = 0; i < width; ++i) {
        const int row = 3 * n[i / 3] + static_cast<int>(i % 3);
        for (std::size_t b = 0; b < n.size(); ++b) {
          const auto first = columns_.begin() + start_[row], last = columns_.begin() + start_[row + 1];
          double* to = values_.data() + (std::lower_bound(first, last, 3 * n[b]) - columns_.begin());
          for (int j = 0; j < 3; ++j) to[j] += K[i * width + 3 * b + j];
        }
      }
    });
  }

  /// y += A x
  void apply(std::span<const double> x, std::span<double> y) const {
    for (std::size_t r = 0; r + 1 < start_.size(); ++r) {
      double sum = 0, odd = 0;
      int k = start_[r];
      for (; k + 1 < start_[r + 1]; k += 2)
        sum += values_[k] * x[columns_[k]], odd += values_[k + 1] * x[columns_[k + 1]];
      if (k < start_[r + 1]) sum += values_[k] * x[columns_[k]];
      y[r] += sum + odd;
    }
  }
  std::size_t bytes() const { return bytes_of(start_) + bytes_of(columns_) + bytes_of(values_); }

 private:
  std::vector<int> start_, columns_;
  std::vector<double> values_;
};

}  // namespace bulbus::bench
