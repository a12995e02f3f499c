#pragma once
#include <optional>

#include "core/problem/problem.hpp"

namespace bulbus {

/// A state with what is derived from it, each computed when first asked for. Problem and state must outlive
/// it.
class Snapshot {
 public:
  Snapshot(const Problem& problem, const State& state) : problem(problem), state(state) {}

  const Problem& problem;
  const State& state;

  /// Collective.
  const Residual& residual() {
    if (!residual_) residual_ = problem.residual(state);
    return *residual_;
  }
  /// Of the local hexahedra; zero in rigid regions.
  const std::vector<CellStress>& stresses() {
    if (!stresses_) stresses_ = problem.solid().stresses(state.x, state.lambda);
    return *stresses_;
  }

 private:
  std::optional<Residual> residual_;
  std::optional<std::vector<CellStress>> stresses_;
};

}  // namespace bulbus
