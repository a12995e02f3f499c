#include "contact/rigid/convex_outline.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "contact/surfaces/meridians.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/unit/contact/bodies.hpp"

namespace bulbus {
namespace {

using std::numbers::pi;

CuttingPlane meridian(double azimuth) {
  const MeridianFrame f(Meridians{}, "");
  return {f.center, cross(f.axis, f.radius(azimuth)), f.axis, f.radius(azimuth)};
}

RigidBodySpec swept(std::vector<std::vector<double>> section, std::vector<double> at, double from,
                    double to) {
  SweptShape s;
  s.section = std::move(section);
  s.at = std::move(at);
  s.arc = {.from = from, .to = to, .facets = 9};
  return {.swept = s};
}

std::vector<std::vector<double>> circle(double r, int n) {
  std::vector<std::vector<double>> s;
  for (int i = 0; i < n; ++i) s.push_back({r * std::cos(2 * pi * i / n), r * std::sin(2 * pi * i / n)});
  return s;
}

// Length √(D² − r²), at the angle asin(r/D) from the way to the centre.
TEST(Tangent, OfACircleAgainstClosedForm) {
  const double r = 2, high = 14;
  const RigidSurface b = body(swept(circle(r, 2000), {1, high}, -20, 25));
  const auto hull = convex_outline(b, meridian(0));  // a station
  for (const Point2 S : {Point2{-4, 12}, {7, 11}, {-9, 3}}) {
    const auto t = outer_tangent(hull, S);
    ASSERT_TRUE(t);
    const double D = std::hypot(1 - S[0], high - S[1]), sign = S[0] < 1 ? 1 : -1;
    const double angle = std::atan2(high - S[1], 1 - S[0]) + sign * std::asin(r / D);
    EXPECT_NEAR(t->direction[0], std::cos(angle), 3e-6);
    EXPECT_NEAR(t->direction[1], std::sin(angle), 3e-6);
    EXPECT_NEAR(t->length, std::sqrt(D * D - r * r), 4e-3);  // T is a corner of the polygon
    for (int c = 0; c < 2; ++c) EXPECT_NEAR(S[c] + t->length * t->direction[c], t->touch[c], 1e-12);
  }
}

TEST(Tangent, OfARectangleIsToItsOuterCorner) {
  const auto hull = convex_outline(
      body(swept({{-3.5, 0}, {3.5, 0}, {3.5, 2.75}, {-3.5, 2.75}}, {0, 12}, 0, 45)), meridian(20));
  const double chord = std::cos(2.5 * pi / 180);  // 20° is a station of 5°
  EXPECT_EQ(hull.size(), 4u);
  for (double side : {-1., 1.}) {
    const Point2 S{side * 4.45, 11.1};
    const auto t = outer_tangent(hull, S);
    ASSERT_TRUE(t);
    EXPECT_NEAR(t->touch[0], side * 3.5, 1e-12);
    EXPECT_NEAR(t->touch[1], 14.75, 1e-9);
  }
  const auto between = convex_outline(
      body(swept({{-3.5, 0}, {3.5, 0}, {3.5, 2.75}, {-3.5, 2.75}}, {0, 12}, 0, 45)), meridian(22.5));
  EXPECT_NEAR(outer_tangent(between, {-4.45, 11.1})->touch[1], 14.75 * chord, 1e-9);
}

TEST(Tangent, AlongAnEdgeTouchesAtItsNearEnd) {
  const std::vector<Point2> square{{-1, 10}, {1, 10}, {1, 12}, {-1, 12}};
  const auto t = outer_tangent(square, {-1, 7});
  ASSERT_TRUE(t);
  EXPECT_EQ(t->touch, (Point2{-1, 10}));
  EXPECT_NEAR(t->length, 3, 1e-14);
  EXPECT_NEAR(t->direction[1], 1, 1e-14);
}

TEST(Tangent, NoneFromInsideOrFromTheOutline) {
  const std::vector<Point2> square{{-1, 10}, {1, 10}, {1, 12}, {-1, 12}};
  EXPECT_FALSE(outer_tangent(square, {0, 11}));
  EXPECT_FALSE(outer_tangent(square, {-1, 11}));
  EXPECT_FALSE(outer_tangent(square, {1, 12}));
  EXPECT_FALSE(outer_tangent({}, {1, 12}));
  EXPECT_TRUE(outer_tangent(square, {-1.000001, 11}));
}

TEST(Tangent, OfAStringThatComesFromFarAboveTheBodyIsStillTheOuterOne) {
  const std::vector<Point2> square{{-1, 10}, {1, 10}, {1, 12}, {-1, 12}};
  EXPECT_EQ(outer_tangent(square, {-5, 13})->touch, (Point2{1, 12}));
}

TEST(Outline, ForgetsHollowsAndStraightCorners) {
  TireShape tire;
  tire.face_facets = 30;
  const Profile s = profile_of(tire, "");
  const auto hull = convex_outline(body({.tire = tire}), meridian(20));
  double lowest = INFINITY;
  for (const Point2& p : hull) lowest = std::min(lowest, p[1]);
  const double a = 3, center = std::sqrt(12.5 * 12.5 - a * a);  // of the inner edges
  EXPECT_NEAR(lowest, center - .5, 2e-2);
  EXPECT_LT(hull.size(), s.size() - 25);
  double twice = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point2 &p = hull[i], &q = hull[(i + 1) % hull.size()], &r = hull[(i + 2) % hull.size()];
    EXPECT_GT((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]), 0);
    twice += p[0] * q[1] - p[1] * q[0];
  }
  EXPECT_GT(twice / 2, signed_area(s));
}

// The plane of symmetry holds the ends of the half band.
TEST(Outline, InThePlaneInWhichTheBodyEnds) {
  const RigidSurface b = body(swept({{-1, 0}, {1, 0}, {1, 1}, {-1, 1}}, {0, 12}, 0, 180));
  for (double azimuth : {0., 180., 60., 7.}) {
    const auto hull = convex_outline(b, meridian(azimuth));
    ASSERT_EQ(hull.size(), 4u) << azimuth;
    double top = 0;
    for (const Point2& p : hull) top = std::max(top, p[1]);
    EXPECT_NEAR(top, azimuth == 7 ? 13 * std::cos(pi / 18) / std::cos(3 * pi / 180) : 13, 1e-9);
  }
  EXPECT_TRUE(convex_outline(b, meridian(270)).empty());
}

TEST(Outline, FollowsTheBody) {
  RigidSurface b = body(swept({{-1, 0}, {1, 0}, {1, 1}, {-1, 1}}, {0, 12}, -10, 35));
  for (std::size_t p = 2; p < b.places.size(); p += 3) b.places[p] += 3;
  for (const Point2& p : not_empty(convex_outline(b, meridian(0))))
    EXPECT_TRUE(std::abs(p[0] - 2) < 1e-12 || std::abs(p[0] - 4) < 1e-12);
}

}  // namespace
}  // namespace bulbus
