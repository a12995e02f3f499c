#pragma once
#include <string>
#include <vector>

#include "app/prepare.hpp"

namespace bulbus {

/// A part of the memory that a run will need at its peak, bytes over all ranks.
struct MemoryPart {
  std::string name;
  double bytes;
};

/// What the run of a prepared scene will hold at its peak: what is resident already and what states, operator, preconditioner and
/// Krylov method (a basis of 30) add, counted number by number; factorisations are estimated from measured ones. Collective.
std::vector<MemoryPart> forecast_memory(const Prepared& prepared, const Scene& scene);

double sum_of(const std::vector<MemoryPart>& parts);

/// Throws InputError if an iterative run would need more than `solver.linear.memory_limit` (or this machine has), with what would make it
/// fit. The direct solver refuses by its own analysis, which knows better.
void refuse_what_cannot_fit(const std::vector<MemoryPart>& parts, const LinearSettings& settings);

}  // namespace bulbus
