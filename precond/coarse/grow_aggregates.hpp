#pragma once
#include <vector>

namespace bulbus::inline precond {

/// Rows i and j of a matrix are strongly coupled where |A_ij| > strong_coupling √(|A_ii| |A_jj|).
inline constexpr double strong_coupling = 0.02;

/// Compact groups of about `size` vertices of a graph, each grown from a seed at the rim of those before it;
/// groups of fewer than four join a neighbour. `excluded`: vertices that get −1. Returns the group of every
/// vertex, counted from 0 without gaps.
std::vector<int> grow_aggregates(const std::vector<std::vector<int>>& neighbours, int size,
                                 const std::vector<char>& excluded);

}  // namespace bulbus::inline precond
