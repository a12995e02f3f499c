#pragma once
#include <string>
#include <vector>

#include "core/problem/problem.hpp"

namespace bulbus::inline app {

/// Sentences about nodes that are held alone, by a set of `fix` or `displace` that has no other, against more
/// than the tissue around one node bears: a force at a point strains it without bound as the mesh gets finer.
/// Collective.
std::vector<std::string> point_supports(const Problem& problem, const State& state);

}  // namespace bulbus::inline app
