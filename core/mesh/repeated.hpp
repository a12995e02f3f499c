#pragma once
#include <utility>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

/// Hexahedra that have the same eight nodes as an earlier one, in whatever order: (the earliest, the later
/// one), ascending in the later one.
std::vector<std::pair<int, int>> repeated(const std::vector<Hex>& hexes);

}  // namespace bulbus::inline mesh
