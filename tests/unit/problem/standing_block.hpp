#pragma once
#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/problem/problem.hpp"
#include "tests/support/models.hpp"

namespace bulbus {

inline Comm world() { return {}; }

inline void expect_near(const Vec3<double>& a, const Vec3<double>& b, double tolerance = 1e-13) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << c;
}

/// A 2 × 1 × 3 block on a fixed bottom.
inline Scene standing_block() {
  Scene s{generate(BlockShape{.upper = {2, 1, 3}, .nx = 2, .ny = 2, .nz = 3}), {}};
  s.model.regions["block"] = neo_hooke(.5);
  s.model.fix.push_back({"zmin", {"x", "y", "z"}});
  s.model.steps = {step("one")};
  return s;
}

inline LoadSpec force(const std::string& set, const Point& f) {
  LoadSpec l;
  l.set = set, l.force = f;
  return l;
}

/// The state at rest under the whole of the first step's loads and motions.
inline State at_end_of_step(Problem& p) {
  State s = p.initial_state();
  p.begin_step(0, s);
  p.set_progress(1, s);
  return s;
}

struct FilledShell : testing::Test {
  Scene scene = filled_shell("octant");
};

}  // namespace bulbus
