#pragma once
#include <vector>

#include "core/solve/coupled_system.hpp"
#include "precond/boomeramg.hpp"

namespace bulbus {

/// Groups each rank's owned nodes into about `count` (over all ranks) compact aggregates along strong couplings of the nodal
/// matrix whose xx, yy and zz parts are given. Returns the aggregate of every owned node, counted from 0 on each rank; nodes of
/// rigid bodies and wholly held nodes have none (−1). Collective.
std::vector<int> aggregate(const CoupledSystem& system, const std::array<DistributedCsr, 3>& scalar, int count);

}  // namespace bulbus
