#pragma once
#include <array>

#include "core/solve/coupled_system.hpp"
#include "precond/amg/boomeramg.hpp"

namespace bulbus::inline precond {

/// The xx, yy and zz parts of the augmented displacement block, constrained directions on the diagonal.
std::array<DistributedCsr, 3> scalar_matrices(const CoupledSystem& system);

}  // namespace bulbus::inline precond
