#include "core/base/pack.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bulbus {
namespace {

double ulps(double got, long double exact) {
  const double near = static_cast<double>(exact);
  return static_cast<double>(std::abs(got - exact)) / (std::nextafter(near, INFINITY) - near);
}

TEST(Pack, InverseCubeRootToFourUlp) {
  for (int i = 0; i <= 4000; ++i) {
    const double x = std::pow(10, -8 + 16 * i / 4000.0);
    ASSERT_LE(ulps(inverse_cube_root(x), 1 / std::cbrt(static_cast<long double>(x))), 4) << x;
  }
}

TEST(Pack, InverseCubeRootOfEveryLane) {
  for (int i = 0; i <= 500; ++i) {
    double x[lanes];
    for (int l = 0; l < lanes; ++l) x[l] = std::pow(10, -8 + 16 * (i * lanes + l) / 4008.0);
    const Pack y = inverse_cube_root(load(x));
    for (int l = 0; l < lanes; ++l)
      ASSERT_LE(ulps(y[l], 1 / std::cbrt(static_cast<long double>(x[l]))), 4) << x[l];
  }
}

TEST(Pack, ExponentialToTwoUlp) {
  for (int i = 0; i <= 8000; ++i) {
    const double x = i < 4000 ? -2 + 4 * i / 4000.0 : -700 + 1409 * (i - 4000) / 4000.0;
    ASSERT_LE(ulps(exponential(x), std::exp(static_cast<long double>(x))), 2) << x;
  }
  EXPECT_EQ(exponential(0.), 1);
}

TEST(Pack, ExponentialOfEveryLane) {
  for (int i = 0; i <= 500; ++i) {
    double x[lanes];
    for (int l = 0; l < lanes; ++l) x[l] = -30 + 60 * (i * lanes + l) / 4008.0;
    const Pack y = exponential(load(x));
    for (int l = 0; l < lanes; ++l)
      ASSERT_LE(ulps(y[l], std::exp(static_cast<long double>(x[l]))), 2) << x[l];
  }
}

TEST(Pack, ExponentialOverflowsToInfinityAndKeepsNaN) {
  const double x[lanes] = {710, 1e300, INFINITY, NAN, -1e300, -INFINITY, 709, 0};
  const Pack y = exponential(load(x));
  for (int l = 0; l < lanes; ++l) {
    const double alone = exponential(x[l]);
    EXPECT_TRUE(y[l] == alone || (std::isnan(y[l]) && std::isnan(alone))) << x[l];
  }
  for (int l = 0; l < 3; ++l) EXPECT_EQ(y[l], INFINITY);
  EXPECT_TRUE(std::isnan(y[3]));
  for (int l = 4; l < 6; ++l) EXPECT_LT(y[l], 1e-300);
  EXPECT_TRUE(std::isfinite(y[6]));
}

TEST(Pack, LoadsAndStoresDoubles) {
  double x[lanes + 1], y[lanes + 1] = {};
  for (int l = 0; l <= lanes; ++l) x[l] = 1.0 / (l + 3);
  store(load(x + 1), y + 1);  // unaligned
  for (int l = 1; l <= lanes; ++l) EXPECT_EQ(y[l], x[l]);
  EXPECT_EQ(y[0], 0);
}

TEST(Pack, LoadsAndStoresFloats) {
  float x[lanes + 1], y[lanes + 1] = {};
  for (int l = 0; l <= lanes; ++l) x[l] = 1.0f / (l + 3);
  const Pack p = load(x + 1);
  for (int l = 0; l < lanes; ++l) EXPECT_EQ(p[l], static_cast<double>(x[l + 1]));
  store(p * 2.0, y + 1);
  for (int l = 1; l <= lanes; ++l) EXPECT_EQ(y[l], 2 * x[l]);
  EXPECT_EQ(y[0], 0);
}

TEST(Pack, ArithmeticIsLanewise) {
  double x[lanes];
  for (int l = 0; l < lanes; ++l) x[l] = l + 1;
  Pack p = (2.0 - load(x)) / load(x) * 3.0;
  p += -load(x);
  for (int l = 0; l < lanes; ++l) EXPECT_DOUBLE_EQ(p[l], (2 - x[l]) / x[l] * 3 - x[l]);
}

}  // namespace
}  // namespace bulbus
