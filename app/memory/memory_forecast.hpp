#pragma once
#include "app/memory/memory_parts.hpp"
#include "app/prepare.hpp"

namespace bulbus::inline app {

/// What a run will hold at its peak, bytes over all ranks.
struct MemoryForecast {
  std::vector<MemoryPart> parts;
  double fallback = 0;  ///< added where MUMPS has to solve a system for GMRES; 0: it never does

  double together() const { return sum_of(parts); }
};

/// Of a prepared scene: what is resident already and what states, operator, preconditioner and Krylov method
/// (a basis of 30) add, counted number by number; factorisations are estimated from measured ones.
/// Collective.
MemoryForecast forecast_memory(const Prepared& prepared, const Scene& scene);

/// A table in MB for people, with a line of the direct fallback and whether it fits.
std::vector<std::string> lines_of(const MemoryForecast& forecast, const LinearSettings& settings);

/// Throws InputError if an iterative run would need more than `solver.linear.memory_limit` (or this machine
/// has), with what would make it fit. The direct solver refuses by its own analysis, which knows better; the
/// direct fallback is not taken where it does not fit.
void refuse_what_cannot_fit(const MemoryForecast& forecast, const LinearSettings& settings);

}  // namespace bulbus::inline app
