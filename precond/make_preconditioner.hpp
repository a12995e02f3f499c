#pragma once
#include "core/solve/linear_solver.hpp"

namespace bulbus {

/// The preconditioner of the coupled system that the settings name. Kept is that of the displacement block; liquids and element
/// pressures are always those of the present linearisation.
PreconditionerFactory make_preconditioner_factory(const LinearSettings& settings, Meters& meters);

/// The solver that `method` names, with the preconditioner that the settings name.
std::unique_ptr<LinearSolver> make_solver(const LinearSettings& settings, Meters& meters);

}  // namespace bulbus
