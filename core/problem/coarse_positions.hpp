#pragma once
#include <span>

#include "core/problem/problem.hpp"

namespace bulbus::inline problem {

/// Positions of a coarser mesh's nodes that were taken over from the finer one may invert coarser hexahedra,
/// though none of the finer is: a suture that draws out a single node does so. Around hexahedra of which J
/// falls below 0.3 somewhere, where an incompressible body has about 1, displacements are replaced by means
/// over the hexahedra at the node, again and again until none is left. Collective.
void relax_inverted(const Problem& coarse, std::span<double> x);

}  // namespace bulbus::inline problem
