#pragma once
#include <vector>

#include "core/solve/coupled_system.hpp"

namespace bulbus::inline solve {

/// Where each of this rank's unknowns is in the linearised state, 3 numbers each, mm: a node, the middle of a
/// hexahedron, the centre of a rigid body; zeros for liquids. Collective.
std::vector<double> unknown_coordinates(const CoupledSystem& system);

/// The near-null space of the displacement block, 6 numbers for each of this rank's unknowns: translations
/// along x, y, z, then rotations about these axes through the origin, e × x in mm, of the linearised state.
/// Constrained directions, held unknowns of bodies and pressures are zero. Collective.
std::vector<double> near_null_space(const CoupledSystem& system);

}  // namespace bulbus::inline solve
