#pragma once
#include "core/solve/linear_solver.hpp"

namespace bulbus {

/// The preconditioner of the coupled system that the settings name, made anew for every linearisation.
PreconditionerFactory make_preconditioner_factory(const LinearSettings& settings, Meters& meters);

}  // namespace bulbus
