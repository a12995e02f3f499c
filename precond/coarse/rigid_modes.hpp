#pragma once
#include <vector>

#include "precond/coarse/block_matrix.hpp"
#include "precond/coarse/coarse_matrix.hpp"

namespace bulbus::inline precond {

/// The six modes of an aggregate: plain ones are three translations and rotations about `center`, each
/// displacing by e × (x − center) · `inverse_radius`.
struct RigidFrame {
  Vec3<double> center{};
  double inverse_radius = 1;
  BlockMatrix::Block
      coordinates{};  ///< of the plain modes in terms of the orthonormal ones, column by plain mode
};

/// Rigid motions of aggregates in the current configuration, without constrained directions, orthonormal
/// within every aggregate.
struct RigidModes {
  std::vector<NodeModes> of;       ///< every local node
  std::vector<RigidFrame> frames;  ///< of every group; those of bodies are not used
  std::vector<int> missing;  ///< this rank's modes that move nothing: coarse unknowns of too small or too
                             ///< much constrained aggregates
};

/// Columns: combinations of six modes with this Gram matrix that are orthonormal, each of it and those before
/// it, so that they follow the nodes without a jump; zero where they are not independent. Both row by row.
BlockMatrix::Block orthonormal_basis(const BlockMatrix::Block& gram);

/// Collective.
RigidModes rigid_modes(const CoupledSystem& system, const Aggregates& groups);

}  // namespace bulbus::inline precond
