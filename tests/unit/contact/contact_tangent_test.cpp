// The tangent of a contact where its nodes stick to a triangle, slide over edges, and turn with their master.
#include <gtest/gtest.h>

#include <set>

#include "core/problem/rigid_body.hpp"
#include "tests/support/sheets.hpp"
#include "tests/support/term_tangent.hpp"

namespace bulbus {
namespace {

/// A small sheet, looking down, sunk into a bent master of 6 × 5 faces.
struct OnABentSheet : testing::Test {
  Sheets sheets;
  std::vector<Quad> slave = sheets.add(2, 2, [](double u, double v) {
    return Vec3<double>{.22 + .1 * v, .31 + .1 * u, height(.22 + .1 * v, .31 + .1 * u) - .01};
  });
  int slaves = sheets.nodes();
  std::vector<Quad> master = sheets.add(6, 5, [](double u, double v) {
    return Vec3<double>{1.2 * u, v, height(1.2 * u, v)};
  });
  ContactTerm term{contact_spec(40, .1),
                   {.penalty = 0, .depth = 0, .reach = .3},
                   {sheets.X, sheets.nodes(), slave, Master(split(master)), {}},
                   Comm()};
  State state = sheets.state();

  static double height(double x, double y) { return .05 * (std::sin(3 * x) + x * y); }

  std::vector<double> force(std::span<const double> x) const {
    std::vector<double> f(x.size());
    term.add_residual({{x.begin(), x.end()}, {}, {}, {}}, f, {});
    return f;
  }
  /// Once the pressures are the predicted ones.
  std::vector<double> action(std::span<const double> d) {
    step_from(state, std::vector<double>(d.size()), term);
    return bulbus::action(term, state, d);
  }
  double error_of_tangent() {
    const auto d = noise_vector(state.x.size(), 4);
    return relative_difference(
        action(d), derivative([&](std::span<const double> x) { return force(x); }, state.x, d, 1e-7));
  }
};

TEST_F(OnABentSheet, TangentIsExactInEveryTriangleThatANodeSlidesThrough) {
  term.begin_step(0, state);
  std::set<int> seen;
  for (int k = 0; k < 40; ++k) {
    for (int n = 0; n < slaves; ++n) {
      state.x[3 * n] += .0131, state.x[3 * n + 1] += .0047;
      state.x[3 * n + 2] = height(state.x[3 * n], state.x[3 * n + 1]) - .01;
    }
    term.set_progress((k + 1) / 40.);
    EXPECT_EQ(term.figures(state).pairs, slaves) << k;
    EXPECT_LT(error_of_tangent(), 1e-6) << k;
    term.commit(state);
    seen.insert(term.memory().triangle[4]);  // of the node in the middle
  }
  EXPECT_GE(seen.size(), 6u);
}

TEST_F(OnABentSheet, TangentIsOfItsStateWhateverStateWasLookedAtBefore) {
  term.begin_step(0, state);
  const auto d = noise_vector(state.x.size(), 5);
  const auto expected = action(d);
  std::vector<double> elsewhere = state.x;
  const auto way = noise_vector(state.x.size(), 6);
  for (double size : {1e-6, .05, .5}) {
    for (std::size_t i = 0; i < way.size(); ++i) elsewhere[i] = state.x[i] + size * way[i];
    force(elsewhere);
    EXPECT_EQ(bulbus::action(term, state, d), expected) << size;
  }
}

TEST_F(OnABentSheet, ForceAndTangentTurnWithTheWhole) {
  const Mat3<double> R = rotation({.4, -1.9, .7});
  const auto turned = [&](std::span<const double> v) {
    std::vector<double> w(v.size());
    for (std::size_t i = 0; i < v.size(); ++i)
      for (int c = 0; c < 3; ++c) w[i] += R(i % 3, c) * v[i / 3 * 3 + c];
    return w;
  };
  const auto d = noise_vector(state.x.size(), 7);
  const auto f = force(state.x), Kd = action(d);
  ASSERT_GT(largest(f), 0);
  state.x = turned(state.x);
  EXPECT_LT(relative_difference(force(state.x), turned(f)), 1e-12);
  EXPECT_LT(relative_difference(action(turned(d)), turned(Kd)), 1e-12);
  EXPECT_LT(error_of_tangent(), 1e-6);
}

}  // namespace
}  // namespace bulbus
