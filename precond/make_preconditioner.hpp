#pragma once
#include "core/solve/linear_solver.hpp"

namespace bulbus::inline precond {

/// The preconditioners of the coupled system that the settings name (see PreconditionerCache).
std::unique_ptr<PreconditionerFactory> make_preconditioner_factory(const LinearSettings& settings,
                                                                   Profiler& profiler);

/// Of the system that is solved: the direct solver factorises it as it is, augmentation would only fill it.
LinearSettings system_settings(LinearSettings settings);

/// The solver that `method` names, with the preconditioner that the settings name.
std::unique_ptr<LinearSolver> make_solver(const LinearSettings& settings, Profiler& profiler);

}  // namespace bulbus::inline precond
