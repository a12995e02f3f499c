#pragma once
#include "core/solve/coupled_operator.hpp"
#include "core/solve/dump.hpp"

namespace bulbus::inline solve {

/// Which entries of a matrix are wanted; the upper triangle says all of a symmetric one.
enum class Triangles { both, upper };

/// The coupled matrix as triplets in the global order of the ranks' unknown vectors: the sum of this rank's
/// contributions, sorted by row and column. Collective.
Triplets assemble(const CoupledOperator& A, Triangles part = Triangles::both);

/// The same without any augmentation, of hexahedra (γ) or of liquids (ω). Collective.
Triplets assemble_plain(const CoupledSystem& system, Triangles part = Triangles::both);

/// Entries that the liquids bring, over all ranks, those that fall upon others included: of 3k free wet
/// displacements 2·3k + 1 bordered, (3k)² + 1 eliminated; in one triangle 3k + 1 and 3k (3k + 1)/2 + 1.
/// Collective.
long long liquid_entries(const CoupledSystem& system, Triangles part = Triangles::both);

/// The displacement block alone (nodal unknowns, γ included), in the order of the ranks' owned nodes.
Triplets assemble_displacement(const CoupledSystem& system, Triangles part = Triangles::both);

/// As many unknowns as can be assembled: matrices have whole numbers of 32 bits.
inline constexpr long long most_assembled = 2147483647;

/// Unknowns of all ranks. Collective.
long long unknowns_of(const Problem& problem);
/// The same; throws InputError where they are too many to be assembled. Collective.
long long global_size(const Problem& problem);

/// Kind of each of this rank's unknowns.
std::vector<UnknownKind> unknown_kinds(const Layout& layout);

}  // namespace bulbus::inline solve
