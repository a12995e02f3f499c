#pragma once
#include <vector>

#include "precond/coarse/rigid_modes.hpp"

namespace bulbus::inline precond {

/// Aggregates of about `size` of this rank's block rows along strong couplings; each of the first `bodies`
/// rows is one of its own, under its own number. The aggregate of every row, counted from 0 on this rank.
std::vector<int> aggregate_blocks(const BlockMatrix& A, int bodies, int size);

/// A space of fewer modes.
struct CoarserModes {
  std::vector<RigidFrame> frames;  ///< of this rank's aggregates
  std::vector<BlockMatrix::Block>
      weights;               ///< of each row: its modes (rows) in those of its aggregate (columns)
  std::vector<int> missing;  ///< this rank's modes that move nothing, counted from 0
};

/// The rigid motions of aggregates of rows with these frames.
CoarserModes coarser_modes(const std::vector<RigidFrame>& frames, const std::vector<int>& group, int bodies);

/// Wᵀ A W; missing modes get a diagonal of their own. Collective.
DistributedBlocks galerkin_product(const Comm& comm, const DistributedBlocks& fine,
                                   const std::vector<int>& group, const CoarserModes& modes,
                                   double missing_diagonal);

}  // namespace bulbus::inline precond
