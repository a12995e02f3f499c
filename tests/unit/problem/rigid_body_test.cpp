#include "core/problem/rigid_body.hpp"

#include <gtest/gtest.h>

#include "tests/support/solids.hpp"

namespace bulbus {
namespace {

struct RigidBodyTest : testing::Test {
  std::vector<double> X = places(shaken_block(1, 1, 1)), x = std::vector<double>(24), f = noise_vector(24, 2);
  Pose pose{rotation({.4, -.7, 1.1}), {.3, -.2, .5}};

  RigidBody body(std::array<bool, 6> free = {true, true, true, true, true, true}) const {
    return {"b", {0, 1, 2, 3, 4, 5, 6, 7}, {.4, .6, .5}, free};
  }
  void SetUp() override { body().place(pose, X, x); }
  std::vector<double> placed(const Pose& p) const {
    std::vector<double> y(24);
    body().place(p, X, y);
    return y;
  }
};

TEST(Rotation, IsOrthogonalAndTurnsByItsAngle) {
  for (double angle : {0.0, 1e-9, 9e-5, 1.1e-4, .5, 3.0, 7.0}) {
    const Vec3<double> a{2. / 3, -1. / 3, 2. / 3};
    const Mat3<double> R = rotation({angle * a[0], angle * a[1], angle * a[2]}), RR = times_transposed(R, R);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(RR(i, j), i == j, 1e-14);
    EXPECT_NEAR(determinant(R), 1, 1e-14);
    EXPECT_NEAR(trace(R), 1 + 2 * std::cos(angle), 1e-14);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(R(i, 0) * a[0] + R(i, 1) * a[1] + R(i, 2) * a[2], a[i], 1e-14);
  }
  EXPECT_NEAR(rotation({0, 0, .1})(1, 0), std::sin(.1), 1e-15);  // x turns to y
}

TEST(Rotation, SpinIsItsInverse) {
  for (double angle : {0.0, 1e-13, 1e-9, 1e-3, .5, 3.0}) {
    const Vec3<double> w{angle * 2 / 3, -angle / 3, angle * 2 / 3}, back = spin(rotation(w));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], w[c], 1e-14) << angle;
  }
}

TEST_F(RigidBodyTest, ReduceIsTheTransposeOfExpand) {
  for (const std::array<bool, 6> free :
       {std::array{true, true, true, true, true, true}, {true, false, true, false, true, false}}) {
    const RigidBody b = body(free);
    const RigidBody::Six q{.1, -.2, .3, .4, -.5, .6};
    std::vector<double> dx(24);
    b.expand(pose, x, q, dx);
    const auto r = b.reduce(pose, x, f, 8);
    EXPECT_NEAR(inner(r, q), inner(f, dx), 1e-13);
  }
}

TEST_F(RigidBodyTest, ExpandIsTheDerivativeOfMoved) {
  const std::vector<double> q{.1, -.2, .3, .4, -.5, .6}, zero(6);
  const auto at = [&](std::span<const double> v) {
    RigidBody::Six six;
    std::copy_n(v.begin(), 6, six.begin());
    return placed(body().moved(pose, six));
  };
  RigidBody::Six six;
  std::copy_n(q.begin(), 6, six.begin());
  std::vector<double> dx(24);
  body().expand(pose, x, six, dx);
  EXPECT_LT(relative_difference(derivative(at, zero, q), dx), 1e-10);
}

// f·x(exp(spin)) to second order in the spin.
TEST_F(RigidBodyTest, GeometricIsTheSecondDerivativeOfTheWorkOfForces) {
  const Mat3<double> G = body().geometric(pose, x, f, 8);
  const auto work = [&](double a, double b, int i, int j) {
    RigidBody::Six q{};
    q[3 + i] += a;
    q[3 + j] += b;
    return inner(f, placed(body().moved(pose, q)));
  };
  const double h = 1e-3;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double mixed =
          (work(h, h, i, j) - work(h, -h, i, j) - work(-h, h, i, j) + work(-h, -h, i, j)) / (4 * h * h);
      EXPECT_NEAR(G(i, j), mixed, 2e-6);
      EXPECT_EQ(G(i, j), G(j, i));
    }
}

TEST_F(RigidBodyTest, HeldMotionsDoNotMove) {
  const RigidBody b = body({true, false, true, false, false, true});
  const Pose p = b.moved(pose, {.1, .2, .3, .4, .5, .6});
  EXPECT_DOUBLE_EQ(p.shift[0], pose.shift[0] + .1);
  EXPECT_EQ(p.shift[1], pose.shift[1]);
  const Mat3<double> expected = rotation({0, 0, .6}) * pose.rotation;
  for (int i = 0; i < 9; ++i) EXPECT_DOUBLE_EQ(p.rotation(i / 3, i % 3), expected(i / 3, i % 3));
}

TEST_F(RigidBodyTest, OnlyOwnedNodesCount) {
  const auto part = body().reduce(pose, x, f, 3);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(part[c], f[c] + f[3 + c] + f[6 + c], 1e-15);
}

}  // namespace
}  // namespace bulbus
