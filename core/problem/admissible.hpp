#pragma once
#include <string>

#include "core/problem/problem.hpp"

namespace bulbus::inline problem {

/// Why no body can be in this state, though it may be in equilibrium: a liquid without volume (its surface is
/// turned inside out), or nodes beyond a plane of symmetry. Empty: nothing speaks against it. Collective.
std::string why_inadmissible(const Problem& problem, const State& state);

}  // namespace bulbus::inline problem
