#include "core/solve/state_increment.hpp"

#include <algorithm>

namespace bulbus::inline solve {
namespace {

// Six halvings; newton.cpp gives an increment up long before, by the length of several steps together.
constexpr double shortest_step = 1.0 / 64;
// J of a Gauss point relative to where the step starts from: a guard, not a model (docs/decisions/033).
constexpr double least_volume = 0.05;

void move(const Problem& problem, const StateIncrement& increment, double length, State& state) {
  problem.dofs().move(state, increment.dx, increment.primal, length);
  for (std::size_t e = 0; e < state.lambda.size(); ++e) state.lambda[e] += length * increment.dlambda[e];
  for (std::size_t i = 0; i < state.P.size(); ++i) state.P[i] += length * increment.dP[i];
}

std::vector<double> scaled_difference(double factor, std::span<const double> to,
                                      std::span<const double> from) {
  std::vector<double> d(to.size());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = factor * (to[i] - from[i]);
  return d;
}

}  // namespace

double move_without_inversion(const Problem& problem, const StateIncrement& increment, State& state,
                              double longest) {
  const double before = std::min(1.0, problem.comm().min(problem.solid().least_jacobian(state.x)));
  for (double length = longest; length >= shortest_step; length /= 2) {
    State trial = state;
    move(problem, increment, length, trial);
    if (problem.comm().min(problem.solid().least_jacobian(trial.x)) > least_volume * before) {
      state = std::move(trial);
      return length;
    }
  }
  return 0;
}

void extrapolate(const Problem& problem, const State& previous, double factor, State& state) {
  const auto turns = problem.dofs().motion(previous.bodies, state.bodies, factor);
  const auto dlambda = scaled_difference(factor, state.lambda, previous.lambda);
  move_without_inversion(problem,
                         {scaled_difference(factor, state.x, previous.x), turns, dlambda,
                          scaled_difference(factor, state.P, previous.P)},
                         state);
  for (const auto& term : problem.terms()) term->extrapolate(factor);
}

}  // namespace bulbus::inline solve
