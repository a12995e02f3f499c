#pragma once
#include "core/solve/coupled_system.hpp"
#include "core/solve/dump.hpp"

namespace bulbus {

/// Which entries of a matrix are wanted; the upper triangle says all of a symmetric one.
enum class Triangle { both, upper };

/// The coupled matrix as triplets in the global order of the ranks' unknown vectors: the sum of this rank's contributions, sorted
/// by row and column. `augmented`: with the γ and ω terms, that is, exactly what CoupledSystem::apply does.
Triplets assemble(const CoupledSystem& system, bool augmented, Triangle part = Triangle::both);

/// The displacement block alone (nodal unknowns, γ included), in the order of the ranks' owned nodes.
Triplets assemble_displacement(const CoupledSystem& system, Triangle part = Triangle::both);

/// Unknowns of all ranks. Collective.
long long global_size(const CoupledSystem& system);

/// Kind of each of this rank's unknowns.
std::vector<UnknownKind> unknown_kinds(const Layout& layout);

}  // namespace bulbus
