#pragma once
#include "core/solve/linear_solver.hpp"

namespace bulbus {

/// The preconditioner of the coupled system that the settings name. With the displacement block's, or with
/// its coarsest factors, the weak patterns' part and the liquids' columns are kept.
PreconditionerFactory make_preconditioner_factory(const LinearSettings& settings, Profiler& profiler);

/// The solver that `method` names, with the preconditioner that the settings name.
std::unique_ptr<LinearSolver> make_solver(const LinearSettings& settings, Profiler& profiler);

}  // namespace bulbus
