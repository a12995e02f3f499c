#pragma once
#include <vector>

namespace bulbus::inline solve {

/// Entries of a square matrix by global row and column, from 0. Every rank gives its own; duplicates are
/// added.
struct Triplets {
  std::vector<int> row, col;
  std::vector<double> value;
};

}  // namespace bulbus::inline solve
