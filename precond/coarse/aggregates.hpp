#pragma once
#include <vector>

#include "core/solve/coupled_system.hpp"

namespace bulbus::inline precond {

/// Groups of nodes in the numbering of all ranks, which counts rigid bodies first: those are groups as they
/// are.
struct Aggregates {
  std::vector<int> of;  ///< group of every local node, ghosts included; −1 of nodes of rigid bodies and of
                        ///< wholly constrained nodes
  int bodies = 0;       ///< rigid bodies, groups 0, 1, ..., held by rank 0
  int first = 0;        ///< first group of this rank's owned nodes
  int mine = 0;         ///< their groups
  int total = 0;        ///< groups of all ranks, bodies included
};

/// Compact aggregates of about `nodes` nodes, each of one rank's owned nodes, along strong couplings of the
/// linearised displacement block. Collective.
Aggregates aggregate(const CoupledSystem& system, int nodes);

/// False where a node has been released that was wholly constrained when they were made. Collective.
bool hold_every_free_node(const Aggregates& groups, const Problem& problem);

}  // namespace bulbus::inline precond
