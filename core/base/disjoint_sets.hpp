#pragma once
#include <numeric>
#include <vector>

namespace bulbus {

/// Numbers 0 to n − 1 in sets that are joined two at a time (union-find with path halving).
class DisjointSets {
 public:
  /// Each number is a set of its own.
  explicit DisjointSets(int n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
  /// The number that stands for the set of `n`.
  int root(int n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  /// The set of `b` takes in that of `a`.
  void join(int a, int b) { parent_[root(a)] = root(b); }

 private:
  std::vector<int> parent_;
};

}  // namespace bulbus
