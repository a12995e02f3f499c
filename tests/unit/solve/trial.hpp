#pragma once
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/solve/march.hpp"
#include "tests/support/models.hpp"

namespace bulbus::test {

/// A march with the direct solver that remembers what it saw.
struct Trial : MarchObserver {
  Comm comm;
  Mesh mesh;
  Problem problem;
  SolverSettings settings;
  Meters meters;
  State state;
  MarchReport report;
  std::vector<Increment> increments;
  std::vector<NewtonReport> cuts;

  explicit Trial(const Scene& scene, const Comm& c = {}) : comm(c), mesh(scene.mesh), problem(scene.mesh, scene.model, c), state(problem.initial_state()) {
    settings.newton = {.force = 1e-10, .volume = 1e-10, .liquid = 1e-10};
  }
  void increment_done(const Increment& i, const State&) override { increments.push_back(i); }
  void increment_cut(const NewtonReport& r, double, double) override { cuts.push_back(r); }
  Trial& go(double gamma = 0) {
    settings.linear.gamma = gamma;
    settings.linear.op = "recompute";
    CoupledSystem system(problem, settings.linear);
    const auto solver = make_direct_solver(settings.linear, meters);
    report = march(problem, system, *solver, state, settings, meters, *this);
    return *this;
  }
  /// Local nodes of a set of the mesh, in use by the model or not.
  std::vector<int> nodes(const std::string& set) const { return problem.mesh().local(nodes_of(mesh, set)); }
  /// Force on a set of held nodes along an axis.
  double reaction(const std::string& set, int axis) const {
    const Residual r = problem.residual(state);
    double sum = 0;
    for (int n : nodes(set))
      if (n < problem.mesh().owned) sum += r.force[3 * n + axis];
    return comm.sum(sum);
  }
};

/// A shell octant filled with liquid at 0.05 MPa, then 8 % more of it.
inline Scene inflated_shell() {
  Scene s = filled_shell("octant");
  s.model.steps[1].add["fluid"] = 2.5;
  s.model.steps[0].displace.clear();
  s.model.steps[1].displace.clear();
  return s;
}

/// Every later iteration squares the distance, as far as round-off lets it.
inline void expect_quadratic(const NewtonReport& r) {
  std::vector<double> e;
  for (const auto& i : r.iterations) e.push_back(std::max({i.balance.force, i.balance.volume, i.balance.liquid}));
  e.push_back(std::max({r.balance.force, r.balance.volume, r.balance.liquid}));
  ASSERT_GE(e.size(), 3u);
  for (std::size_t k = 1; k + 1 < e.size(); ++k)
    if (e[k] < .1) {
      EXPECT_LT(e[k + 1], std::max(100 * e[k] * e[k], 1e-13)) << k << ' ' << e[k];
    }
}

}  // namespace bulbus::test
