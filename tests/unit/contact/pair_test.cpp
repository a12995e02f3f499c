#include "contact/pair.hpp"

#include <gtest/gtest.h>

#include "contact/pressure_law.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {
namespace {

/// Twelve numbers: the slave node, then the corners.
Pair pair_of(std::span<const double> u) {
  const auto v = [&](int i) { return Vec3<double>{u[3 * i], u[3 * i + 1], u[3 * i + 2]}; };
  return project(v(0), {v(1), v(2), v(3)});
}

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
  return Mat3<double>{{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}}} * Mat3<double>{{{{1, 0, 0}, {0, c, -s}, {0, s, c}}}};
}

TEST(Pair, KnowsAGapByHand) {
  const Pair p = pair_of(std::vector<double>{.5, .25, -.125, 0, 0, 0, 2, 0, 0, 0, 1, 0});
  EXPECT_DOUBLE_EQ(p.gap, -.125);
  EXPECT_EQ(p.normal, (Vec3<double>{0, 0, 1}));
  EXPECT_EQ(p.weights, (std::array<double, 3>{.5, .25, .25}));
}

TEST(Pair, DIsTheGradientOfTheGap) {
  for (int seed = 0; seed < 20; ++seed) {
    const auto u = some_pair(seed), d = noise_vector(12, seed + 100);
    const auto gap = [](std::span<const double> v) { return std::vector{pair_of(v).gap}; };
    EXPECT_NEAR(inner(gradient(pair_of(u)), d), derivative(gap, u, d)[0], 1e-9);
  }
}

TEST(Pair, HIsTheDerivativeOfD) {
  for (int seed = 0; seed < 20; ++seed) {
    const auto u = some_pair(seed), d = noise_vector(12, seed + 100);
    const auto D = [](std::span<const double> v) {
      const auto g = gradient(pair_of(v));
      return std::vector(g.begin(), g.end());
    };
    const auto H = tangent(pair_of(u), 0, 1);
    std::vector<double> Hd(12);
    for (int r = 0; r < 12; ++r)
      for (int c = 0; c < 12; ++c) Hd[r] += H[12 * r + c] * d[c];
    EXPECT_LT(relative_difference(Hd, derivative(D, u, d)), 1e-9);
  }
}

// force α G D of the potential (α/2) G²
TEST(Pair, TangentIsTheDerivativeOfTheForceStickingOrSliding) {
  const double alpha = 7;
  for (double slide : {0., .3, 1.4}) {  // the last foot lies beyond an edge
    auto u = some_pair(3);
    u[0] += slide;
    const auto force = [&](std::span<const double> v) {
      const Pair p = pair_of(v);
      const auto D = gradient(p);
      std::vector<double> f(12);
      for (int i = 0; i < 12; ++i) f[i] = alpha * p.gap * D[i];
      return f;
    };
    const auto d = noise_vector(12, 5);
    const Pair p = pair_of(u);
    const auto K = tangent(p, alpha, alpha * p.gap);
    std::vector<double> Kd(12);
    for (int r = 0; r < 12; ++r)
      for (int c = 0; c < 12; ++c) Kd[r] += K[12 * r + c] * d[c];
    EXPECT_LT(relative_difference(Kd, derivative(force, u, d)), 1e-9) << slide;
  }
}

TEST(Pair, TangentIsSymmetricAndItsGramPartPositive) {
  const Pair p = pair_of(some_pair(8));
  const auto K = tangent(p, 3, -2), gram = tangent(p, 3, 0);
  const auto d = noise_vector(12, 1);
  double energy = 0;
  for (int r = 0; r < 12; ++r)
    for (int c = 0; c < 12; ++c) {
      EXPECT_DOUBLE_EQ(K[12 * r + c], K[12 * c + r]);
      energy += d[r] * gram[12 * r + c] * d[c];
    }
  EXPECT_NEAR(energy, 3 * std::pow(inner(gradient(p), d), 2), 1e-13);
}

TEST(Pair, TurnsWithTheWhole) {
  const auto u = some_pair(4);
  const auto R = rotation(2.1);
  const Pair p = pair_of(u), q = pair_of(rotated(R, u));
  EXPECT_NEAR(p.gap, q.gap, 1e-14);
  EXPECT_LT(relative_difference(gradient(q), rotated(R, gradient(p))), 1e-13);
}

TEST(Pair, ForcesBalanceWithTheirMoments) {
  const auto u = some_pair(6);
  const auto D = gradient(pair_of(u));
  Vec3<double> force{0, 0, 0}, moment{0, 0, 0};
  for (int i = 0; i < 4; ++i) {
    const Vec3<double> f{D[3 * i], D[3 * i + 1], D[3 * i + 2]};
    const Vec3<double> m = cross({u[3 * i], u[3 * i + 1], u[3 * i + 2]}, f);
    for (int c = 0; c < 3; ++c) force[c] += f[c], moment[c] += m[c];
  }
  EXPECT_LT(norm(force), 1e-15);
  EXPECT_LT(norm(moment), 1e-15);
}

TEST(ContactPressure, IsTheDerivativeOfItsIntegralAndContinuousInSlope) {
  for (double width : {0., .5})
    for (double tau = -1.05; tau < 1.1; tau += .1) {
      const double h = 1e-5;
      const auto p = contact_pressure(tau, width), up = contact_pressure(tau + h, width), down = contact_pressure(tau - h, width);
      EXPECT_NEAR(p.value, (up.integral - down.integral) / (2 * h), 1e-9);
      EXPECT_NEAR(p.slope, (up.value - down.value) / (2 * h), 1e-9);
    }
  const double e = 1e-9;
  for (double edge : {-.5, .5})
    EXPECT_NEAR(contact_pressure(edge - e, .5).slope, contact_pressure(edge + e, .5).slope, 1e-8);
}

}  // namespace
}  // namespace bulbus
