#pragma once
#include <any>
#include <map>
#include <optional>
#include <span>

#include "core/problem/problem.hpp"

namespace bulbus::inline problem {

/// A state with what is derived from it, each computed when first asked for. Problem and state must outlive
/// it.
class Snapshot {
 public:
  Snapshot(const Problem& problem, const State& state)
      : problem(problem), state(state), origin(problem.mesh().X) {}

  const Problem& problem;
  const State& state;
  /// Positions of the local nodes that displacements count from: the reference ones unless set otherwise.
  std::span<const double> origin;

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
  /// What a floor above derives from the state, under the address of what it is derived by.
  template <class Make>
  const auto& derived(const void* by, Make make) {
    using T = decltype(make());
    std::any& kept = derived_[by];
    if (!kept.has_value()) kept = make();
    return *std::any_cast<T>(&kept);
  }

 private:
  std::optional<Residual> residual_;
  std::optional<std::vector<CellStress>> stresses_;
  std::map<const void*, std::any> derived_;
};

}  // namespace bulbus::inline problem
