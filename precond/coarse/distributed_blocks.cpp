#include "precond/coarse/distributed_blocks.hpp"

#include <algorithm>
#include <bit>

#include "core/base/sort_unique.hpp"

namespace bulbus::inline precond {
namespace {

using Block = BlockMatrix::Block;
using Parcels = std::vector<std::vector<long long>>;  // from or to each rank

std::vector<long long> first_rows(const Comm& comm, int mine) {
  const long long first = comm.offset(static_cast<long long>(mine));
  return comm.gather(std::span<const long long>(&first, 1));
}

int owner_of(long long row, const std::vector<long long>& firsts) {
  return static_cast<int>(std::ranges::upper_bound(firsts, row) - firsts.begin()) - 1;
}

void pack(long long row, long long column, const Block& block, std::vector<long long>& to) {
  to.push_back(row), to.push_back(column);
  for (double v : block) to.push_back(std::bit_cast<long long>(v));
}

void unpack(const Parcels& parcels, const BlockVisitor& visit) {
  for (const auto& parcel : parcels)
    for (auto at = parcel.begin(); at != parcel.end();) {
      const long long row = *at++, column = *at++;
      Block block;
      for (double& v : block) v = std::bit_cast<double>(*at++);
      visit(row, column, block);
    }
}

}  // namespace

int BlockRows::local(long long row) const {
  if (row >= first && row < first + mine) return static_cast<int>(row - first);
  return mine + static_cast<int>(std::ranges::lower_bound(ghosts, row) - ghosts.begin());
}

BlockRows block_rows(const Comm& comm, int mine, std::vector<long long> ghosts) {
  sort_unique(ghosts);
  const auto firsts = first_rows(comm, mine);
  Parcels wanted(comm.size());
  std::vector<std::vector<int>> receive(comm.size());
  for (std::size_t k = 0; k < ghosts.size(); ++k) {
    const int owner = owner_of(ghosts[k], firsts);
    wanted[owner].push_back(ghosts[k]);
    receive[owner].push_back(mine + static_cast<int>(k));
  }
  const Parcels asked = comm.exchange(wanted);
  std::vector<Halo::Neighbour> neighbours;
  for (int r = 0; r < comm.size(); ++r) {
    if (asked[r].empty() && receive[r].empty()) continue;
    Halo::Neighbour n{r, {}, receive[r]};
    for (long long row : asked[r]) n.send.push_back(static_cast<int>(row - firsts[comm.rank()]));
    neighbours.push_back(std::move(n));
  }
  return {firsts[comm.rank()], comm.sum(static_cast<long long>(mine)), mine, std::move(ghosts),
          Halo(comm, std::move(neighbours))};
}

DistributedBlocks assemble_blocks(const Comm& comm, int mine,
                                  const std::function<void(const BlockVisitor&)>& each) {
  const auto firsts = first_rows(comm, mine);
  const auto is_mine = [&](long long row) { return owner_of(row, firsts) == comm.rank(); };
  Parcels away(comm.size());
  std::vector<std::array<long long, 2>> places;
  each([&](long long row, long long column, const Block& block) {
    if (is_mine(row))
      places.push_back({row, column});
    else
      pack(row, column, block, away[owner_of(row, firsts)]);
  });
  const Parcels here = comm.exchange(away);
  unpack(here, [&](long long row, long long column, const Block&) { places.push_back({row, column}); });
  sort_unique(places);
  std::vector<long long> ghosts;
  for (const auto& [row, column] : places)
    if (!is_mine(column)) ghosts.push_back(column);
  DistributedBlocks blocks{block_rows(comm, mine, std::move(ghosts)), {}};
  std::vector<std::array<int, 2>> local;
  for (const auto& [row, column] : places)
    local.push_back({blocks.rows.local(row), blocks.rows.local(column)});
  blocks.A = BlockMatrix(mine, std::move(local));
  const auto add = [&](long long row, long long column, const Block& block) {
    if (is_mine(row)) blocks.A.add(blocks.rows.local(row), blocks.rows.local(column), block);
  };
  each(add);
  unpack(here, add);
  blocks.A.invert_diagonal();
  return blocks;
}

}  // namespace bulbus::inline precond
