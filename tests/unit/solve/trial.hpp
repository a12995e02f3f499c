#pragma once
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/support/march_trial.hpp"

namespace bulbus::test {

/// A march with the direct solver that remembers what was cut.
struct Trial : MarchTrial {
  Mesh mesh;
  std::vector<NewtonReport> cuts;
  std::vector<double> tried;  // parts of a step, of what was cut

  explicit Trial(const Scene& scene, const Comm& c = {})
      : MarchTrial(scene, c, {.force = 1e-10, .volume = 1e-10, .liquid = 1e-10}), mesh(scene.mesh) {}
  void increment_cut(const NewtonReport& r, double from, double to) override {
    cuts.push_back(r);
    tried.push_back(to - from);
  }
  Trial& go(double gamma = 0) {
    settings.linear.gamma = gamma;
    settings.linear.op = TangentStorage::recompute;
    march_with(make_direct_solver(settings.linear, profiler));
    return *this;
  }
  std::vector<int> nodes(const std::string& set) const { return MarchTrial::nodes(mesh, set); }
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
  for (const auto& i : r.iterations) e.push_back(std::max({i.error.force, i.error.volume, i.error.liquid}));
  e.push_back(std::max({r.error.force, r.error.volume, r.error.liquid}));
  ASSERT_GE(e.size(), 3u);
  for (std::size_t k = 1; k + 1 < e.size(); ++k)
    if (e[k] < .1) {
      EXPECT_LT(e[k + 1], std::max(100 * e[k] * e[k], 1e-13)) << k << ' ' << e[k];
    }
}

}  // namespace bulbus::test
