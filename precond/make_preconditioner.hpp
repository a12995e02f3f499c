#pragma once
#include "core/solve/linear_solver.hpp"

namespace bulbus::inline precond {

/// The preconditioners of the coupled system that the settings name (see PreconditionerCache).
std::unique_ptr<PreconditionerFactory> make_preconditioner_factory(const LinearSettings& settings,
                                                                   Profiler& profiler);

/// The solver that `method` names, with the preconditioner that the settings name.
std::unique_ptr<LinearSolver> make_solver(const LinearSettings& settings, Profiler& profiler);

}  // namespace bulbus::inline precond
