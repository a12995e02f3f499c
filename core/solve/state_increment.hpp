#pragma once
#include <span>
#include <vector>

#include "core/problem/problem.hpp"

namespace bulbus::inline solve {

/// By what a state moves: a Newton step, or the way between two states.
struct StateIncrement {
  std::vector<double> dx;          ///< local nodes, ghosts included, mm
  std::span<const double> primal;  ///< its tail: six unknowns of every rigid body (DofMap)
  std::span<const double> dlambda;
  std::vector<double> dP;
};

/// Step guard of Newton's method, in place of a line search or damping (formulation, section 8.3): moves
/// `state` by the longest part of the increment that inverts no element, out of `longest`, its half, its
/// quarter and so on. Returns that part; 0 where none of at least 1/64 does. Collective.
double move_without_inversion(const Problem& problem, const StateIncrement& increment, State& state,
                              double longest = 1);

/// Linear extrapolation: moves `state` on by `factor` times its way from `previous`, as far as no element
/// inverts, and tells the problem's terms. Collective.
void extrapolate(const Problem& problem, const State& previous, double factor, State& state);

}  // namespace bulbus::inline solve
