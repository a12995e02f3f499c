#pragma once
#include <array>

namespace bulbus::inline mesh {

/// The two corners of every edge of a Hex.
inline constexpr std::array<std::array<int, 2>, 12> hex_edges{
    {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

}  // namespace bulbus::inline mesh
