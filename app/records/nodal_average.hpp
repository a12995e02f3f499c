#pragma once
#include <span>
#include <vector>

#include "core/problem/problem.hpp"

namespace bulbus::inline app {

/// Cell values (`width` per local hexahedron) averaged to the local nodes, weighted by the cells' reference
/// volumes. Blind to regions: a node between two tissues gets a mean of both. Rigid cells do not count; a
/// node of rigid cells alone gets zero. Collective.
std::vector<double> nodal_average(const Problem& problem, std::span<const double> cell_values, int width);

}  // namespace bulbus::inline app
