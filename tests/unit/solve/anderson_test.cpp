#include "core/solve/anderson.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace bulbus;

constexpr int n = 12;

/// What x ← M x + b adds to x; M has the eigenvalues 1.5, −0.9 and others below 0.6: without acceleration the
/// iteration diverges.
std::vector<double> added(std::span<const double> x) {
  std::vector<double> f(n);
  for (int i = 0; i < n; ++i) {
    const double eigenvalue = i == 0 ? 1.5 : i == 1 ? -.9 : .05 * i;
    f[i] = eigenvalue * x[i] + 1 + i - x[i];
  }
  return f;
}

double length_of(std::span<const double> f) {
  double sum = 0;
  for (double v : f) sum += v * v;
  return std::sqrt(sum);
}

int iterations(int depth) {
  AndersonAcceleration anderson(depth, n, Comm(MPI_COMM_SELF));
  std::vector<double> x(n);
  for (int k = 0; k < 100; ++k) {
    const auto f = added(x);
    if (length_of(f) < 1e-8) return k;
    x = anderson.next(x, f);
  }
  return 100;
}

/// With all differences at hand it is GMRES: of twelve eigenvalues the thirteenth residual is zero.
TEST(Anderson, EndsAsGmresDoes) {
  EXPECT_EQ(iterations(0), 100);
  EXPECT_LE(iterations(n), n + 3);
  EXPECT_LT(iterations(5), 40);
}

TEST(Anderson, WithoutDepthIsTheFixedPoint) {
  AndersonAcceleration anderson(0, 2, Comm(MPI_COMM_SELF));
  for (int k = 0; k < 3; ++k) {
    const auto x = anderson.next(std::vector{1., 2.}, std::vector{.5, -.25});
    EXPECT_EQ(x[0], 1.5);
    EXPECT_EQ(x[1], 1.75);
  }
}

/// Numbers of ghosts follow the owners', but do not count.
TEST(Anderson, GhostsDoNotCount) {
  AndersonAcceleration plain(3, 2, Comm(MPI_COMM_SELF)), ghosts(3, 2, Comm(MPI_COMM_SELF));
  std::vector<double> x{0, 0}, y{0, 0, 0};
  for (int k = 0; k < 4; ++k) {
    const std::vector<double> f{1 - 1.5 * x[0] + .2 * x[1], 2 + .3 * x[0] - .7 * x[1]};
    x = plain.next(x, f);
    y = ghosts.next(y, std::vector{f[0], f[1], f[0]});
    EXPECT_EQ(y[0], x[0]);
    EXPECT_EQ(y[1], x[1]);
    EXPECT_EQ(y[2], x[0]);
  }
}

}  // namespace
