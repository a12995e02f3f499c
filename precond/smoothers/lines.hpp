#pragma once
#include <vector>

#include "core/problem/problem.hpp"

namespace bulbus::inline precond {

/// The owned nodes of one rank in lines along their strongest couplings; line k holds nodes[start[k]] ..
/// nodes[start[k + 1]]. Nodes without a strong coupling are lines of their own.
struct Lines {
  std::vector<int> start{0}, nodes;
  int count() const { return static_cast<int>(start.size()) - 1; }
};

/// Follows the edges of the mesh. An edge couples by Σ μ_e V_e / ℓ² over its hexahedra, in the reference
/// configuration, and is strong where that outweighs what either end has besides its two strongest edges: in
/// thin layers, through the thickness.
Lines find_lines(const Problem& problem);

}  // namespace bulbus::inline precond
