#pragma once
#include "app/memory_parts.hpp"
#include "app/prepare.hpp"

namespace bulbus {

/// What the run of a prepared scene will hold at its peak: what is resident already and what states,
/// operator, preconditioner and Krylov method (a basis of 30) add, counted number by number; factorisations
/// are estimated from measured ones. Collective.
std::vector<MemoryPart> forecast_memory(const Prepared& prepared, const Scene& scene);

/// Throws InputError if an iterative run would need more than `solver.linear.memory_limit` (or this machine
/// has), with what would make it fit. The direct solver refuses by its own analysis, which knows better.
void refuse_what_cannot_fit(const std::vector<MemoryPart>& parts, const LinearSettings& settings);

}  // namespace bulbus
