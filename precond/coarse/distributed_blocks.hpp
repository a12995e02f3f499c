#pragma once
#include <functional>
#include <vector>

#include "core/mesh/distributed/halo.hpp"
#include "precond/coarse/block_matrix.hpp"

namespace bulbus::inline precond {

/// Block rows that the ranks share by contiguous parts: this rank's, and those of others that its matrix
/// refers to. Local numbers count its own first.
struct BlockRows {
  long long first = 0, total = 0;  ///< number of this rank's first row, and of all
  int mine = 0;
  std::vector<long long> ghosts;  ///< numbers of the others, ascending
  Halo halo;
  int size() const { return mine + static_cast<int>(ghosts.size()); }
  int local(long long row) const;
  long long global(int row) const { return row < mine ? first + row : ghosts[row - mine]; }
};

/// `ghosts`: in any order, each any number of times. Collective.
BlockRows block_rows(const Comm& comm, int mine, std::vector<long long> ghosts);

/// A matrix by block rows; columns in local numbers.
struct DistributedBlocks {
  BlockRows rows;
  BlockMatrix A;
};

using BlockVisitor = std::function<void(long long row, long long column, const BlockMatrix::Block&)>;

/// The sum of the blocks of all ranks, which `each` visits, twice; those of other ranks' rows go there.
/// `mine`: rows of this rank. Collective.
DistributedBlocks assemble_blocks(const Comm& comm, int mine,
                                  const std::function<void(const BlockVisitor&)>& each);

}  // namespace bulbus::inline precond
