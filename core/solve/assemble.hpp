#pragma once
#include "core/solve/coupled_operator.hpp"
#include "core/solve/dump.hpp"

namespace bulbus::inline solve {

/// Which entries of a matrix are wanted; the upper triangle says all of a symmetric one.
enum class Triangles { both, upper };

/// Compressibility of hexahedra, in parts of 1/μ_e, that matrices get which are to be factorised. A
/// checkerboard mode of the pressures that strains no displacement is then no part of the solution but for
/// rounding over this number, whatever the ordering; without it a null pivot sets one pressure to zero, and
/// adds the mode in as large a multiple as that takes. What it changes of the solution is this number's part.
inline constexpr double regularisation = 1e-10;

/// The coupled matrix as triplets in the global order of the ranks' unknown vectors: the sum of this rank's
/// contributions, sorted by row and column. The diagonal of element pressures gets −`compressibility`
/// V0_e/μ_e. Collective.
Triplets assemble(const CoupledOperator& A, Triangles part = Triangles::both, double compressibility = 0);

/// The same without any augmentation, of hexahedra (γ) or of liquids (ω). Collective.
Triplets assemble_plain(const CoupledSystem& system, Triangles part = Triangles::both,
                        double compressibility = 0);

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
