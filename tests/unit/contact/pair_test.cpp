#include "contact/surfaces/pair.hpp"

#include <gtest/gtest.h>

#include "contact/law/pressure_law.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {
namespace {

/// Twelve numbers: the slave node, then the corners.
Pair pair_of(std::span<const double> u) { return project(at(u, 0), Triangle{at(u, 1), at(u, 2), at(u, 3)}); }

std::vector<double> some_pair(int seed) {
  std::vector<double> u{.3, .25, -.1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  for (int i = 0; i < 12; ++i) u[i] += .2 * noise(seed, i);
  return u;
}

std::vector<double> rotated(const Mat3<double>& R, std::span<const double> u) {
  std::vector<double> v(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    const std::size_t n = i / 3 * 3, c = i % 3;
    v[i] = R(c, 0) * u[n] + R(c, 1) * u[n + 1] + R(c, 2) * u[n + 2];
  }
  return v;
}

Mat3<double> rotation(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return Mat3<double>{{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}} *
         Mat3<double>{{{{1, 0, 0}, {0, c, -s}, {0, s, c}}}};
}

TEST(Pair, KnowsAGapByHand) {
  const Pair p = pair_of(std::vector<double>{.5, .25, -.125, 0, 0, 0, 2, 0, 0, 0, 1, 0});
  EXPECT_DOUBLE_EQ(p.gap, -.125);
  EXPECT_EQ(p.normal, (Vec3<double>{0, 0, 1}));
  EXPECT_EQ(p.weights, (std::array<double, 3>{.5, .25, .25}));
}

TEST(Pair, TurnsWithTheWhole) {
  const auto u = some_pair(4);
  const auto R = rotation(2.1);
  const Pair p = pair_of(u), q = pair_of(rotated(R, u));
  EXPECT_NEAR(p.gap, q.gap, 1e-14);
  EXPECT_LT(relative_difference(q.normal, rotated(R, p.normal)), 1e-13);
  EXPECT_LT(relative_difference(q.weights, p.weights), 1e-13);
}

TEST(ContactPressure, IsTheDerivativeOfItsIntegral) {
  for (double tau = -1.05; tau < 1.1; tau += .1) {
    const double h = 1e-5;
    const auto p = contact_pressure(tau), up = contact_pressure(tau + h), down = contact_pressure(tau - h);
    EXPECT_NEAR(p.value, (up.integral - down.integral) / (2 * h), 1e-9);
    EXPECT_NEAR(p.slope, (up.value - down.value) / (2 * h), 1e-9);
    EXPECT_GE(p.value, 0);
  }
}

TEST(StillActive, KeepsPairsOfPredictedPressureOnly) {
  EXPECT_TRUE(still_active(-.5, .1));
  EXPECT_TRUE(still_active(.5, .1));
  EXPECT_FALSE(still_active(-1.01 * most_tension, 1)) << "opened too far for the prediction to be believed";
  for (double tau : {-1e-9, -1., 1.}) EXPECT_FALSE(still_active(tau, 0)) << "no prediction";
  for (double tau : {-1e-9, -1.}) EXPECT_FALSE(still_active(tau, -.1)) << "in tension";
}

}  // namespace
}  // namespace bulbus
