#pragma once
#include <vector>

#include "core/base/parallel.hpp"
#include "core/solve/triplets.hpp"

namespace bulbus::inline solve {

/// An order of elimination in which a factorisation without exchange of pivots exists if the rest is positive
/// definite: METIS on the graph of the unknowns whose diagonal is not zero, and the others (pressures of
/// hexahedra) each after the last one that it couples to. position[i] of each of the n unknowns of all ranks,
/// the same on each, for the sum of the ranks' triplets; one triangle is enough. Collective.
std::vector<int> nested_dissection(const Triplets& matrix, int n, const Comm& comm);

}  // namespace bulbus::inline solve
