#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "core/problem/probes/probe_figures.hpp"
#include "precond/make_preconditioner.hpp"
#include "tests/support/march_trial.hpp"

namespace bulbus {

/// Tolerances that leave round-off only, for comparisons with closed forms.
inline NewtonSettings tight(double force = 1e-11, double liquid = 1e-12) {
  return {.force = force, .volume = 1e-11, .liquid = liquid, .eta_max = 1e-4};
}

/// A march with either solver, to round-off.
struct Trial : MarchTrial {
  /// Called after every increment.
  std::function<void(const Increment&, const State&)> watch;

  explicit Trial(const Scene& scene, const Comm& c = {}) : MarchTrial(scene, c, tight()) {}
  void increment_done(const Increment& i, const State& s) override {
    MarchTrial::increment_done(i, s);
    if (watch) watch(i, s);
  }
  Trial& with(std::unique_ptr<LinearSolver> solver) {
    march_with(std::move(solver));
    return *this;
  }
  Trial& direct() {
    settings.linear.method = Method::direct;
    settings.linear.gamma = 0;
    return with(make_direct_solver(settings.linear, profiler));
  }
  Trial& iterative() {
    return with(make_krylov_solver(settings.linear, make_preconditioner_factory(settings.linear, profiler),
                                   profiler));
  }

  double displacement(int local_node, int axis) const {
    return state.x[3 * local_node + axis] - problem.mesh().X[3 * local_node + axis];
  }
  /// Radial displacement in a sphere: mean of |x| − |X| over the owned nodes of a set.
  double mean_radial(const Mesh& mesh, const std::string& set) const {
    double sum = 0, count = 0;
    for (int n : nodes(mesh, set))
      if (n < problem.mesh().owned) sum += norm(at(state.x, n)) - norm(at(problem.mesh().X, n)), ++count;
    return comm.sum(sum) / comm.sum(count);
  }
  /// Mean nominal stress from nodal forces alone: Σ f ⊗ X = ∫ P dV.
  Mat3<double> virial() const {
    const Residual r = problem.residual(state);
    Mat3<double> P{};
    double V = 0;
    for (double v : problem.solid().reference_volumes()) V += v;
    V = comm.sum(V);
    for (int n = 0; n < problem.mesh().owned; ++n)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) P(i, j) += r.force[3 * n + i] * problem.mesh().X[3 * n + j] / V;
    comm.sum(std::span(&P(0, 0), 9));
    return P;
  }
  double figure(const ProbeSet::Figure& f) const {
    Snapshot s(problem, state);
    return f(s);
  }
};

/// One line of the record of what was measured.
template <class... A>
void measured(fmt::format_string<A...> text, A&&... a) {
  if (Comm().rank() != 0) return;
  fmt::print("[ measured ] {}\n", fmt::format(text, std::forward<A>(a)...));
  std::fflush(stdout);
}

inline double relative(double value, double reference) { return std::abs(value / reference - 1); }

/// Largest number of Krylov iterations of one linear solve of the increments that converged.
inline int most_krylov(const Trial& run) {
  int most = 0;
  for (const Increment& i : run.increments)
    for (const NewtonIteration& n : i.newton.iterations) most = std::max(most, n.linear.iterations);
  return most;
}

}  // namespace bulbus
