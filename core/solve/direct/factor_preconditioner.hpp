#pragma once
#include <memory>

#include "core/solve/linear_solver.hpp"

namespace bulbus::inline solve {

/// Preconditioners of the whole system that are its factors by the direct solver of the settings: exact but
/// for rounding.
std::unique_ptr<PreconditionerFactory> make_factor_preconditioners(const LinearSettings& settings,
                                                                   Profiler& profiler);

}  // namespace bulbus::inline solve
