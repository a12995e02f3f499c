#pragma once
#include <vector>

#include "precond/coarse/coarse_matrix.hpp"

namespace bulbus {

/// Rigid motions of aggregates in the current configuration, without constrained directions, orthonormal
/// within every aggregate.
struct RigidModes {
  std::vector<NodeModes> of;  ///< every local node
  std::vector<int> missing;   ///< this rank's modes that move nothing: coarse unknowns of too small or too
                              ///< much constrained aggregates
};

/// Collective.
RigidModes rigid_modes(const CoupledSystem& system, const Aggregates& groups);

}  // namespace bulbus
