#include "contact/surfaces/smoothed_facets.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/rigid/rigid_shapes.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {
namespace {

Triangle corners_of(const RigidSurface& body, int t) {
  Triangle c;
  for (int i = 0; i < 3; ++i) std::copy_n(&body.places[3 * body.facets.triangles[t][i]], 3, c[i].begin());
  return c;
}

RigidSurface ball(double radius) {
  RigidBodySpec spec;
  spec.sphere = SphereShape{.radius = radius, .facets = 24};
  return make_rigid_surface("ball", spec, "rigid_bodies.ball");
}

FaceGap gap_at(const RigidSurface& body, int t, const Vec3<double>& x) {
  const Triangle c = corners_of(body, t);
  return smoothed_gap(x, project(x, c), c, body.normals[t]);
}

// A place above triangle t: its weights, then the height.
Vec3<double> above(const RigidSurface& body, int t, const Vec3<double>& L, double height) {
  const Triangle c = corners_of(body, t);
  const Vec3<double> n = project(c[0], c).normal;
  Vec3<double> x;
  for (int k = 0; k < 3; ++k) x[k] = L[0] * c[0][k] + L[1] * c[1][k] + L[2] * c[2][k] + height * n[k];
  return x;
}

TEST(CurvedGap, OfABallIsTheDistanceToIt) {
  const RigidSurface b = ball(2);
  double mean = 0, worst = 0, flat = 0;
  const int triangles = static_cast<int>(b.facets.triangles.size());
  for (int t = 0; t < triangles; ++t)
    for (const Vec3<double>& L : {Vec3<double>{.6, .3, .1}, {.2, .2, .6}, {1. / 3, 1. / 3, 1. / 3}}) {
      const Vec3<double> x = above(b, t, L, -.002);
      const FaceGap g = gap_at(b, t, x);
      worst = worse(worst, std::abs(g.gap - (norm(x) - 2)));
      flat = std::max(flat, std::abs(project(x, corners_of(b, t)).gap - (norm(x) - 2)));
      EXPECT_NEAR(norm(g.normal), 1, 1e-14);
      EXPECT_GT(dot(g.normal, x) / norm(x), 1 - 2e-5);
      mean += trace(g.bend) / triangles / 3;
    }
  EXPECT_LT(worst, flat / 20);
  EXPECT_NEAR(mean, 2 / 2., 0.02);
}

// The normal is the gap's gradient to second order in the angle between the corners' normals, here .26 at
// most.
TEST(CurvedGap, HasItsGradientAndBend) {
  const RigidSurface b = ball(2);
  for (int t : {0, 7, 100}) {
    const Vec3<double> x = above(b, t, {.5, .2, .3}, -.03);
    const FaceGap g = gap_at(b, t, x);
    Mat3<double> turn;
    for (int c = 0; c < 3; ++c) {
      Vec3<double> up = x, down = x;
      up[c] += 1e-5, down[c] -= 1e-5;
      const FaceGap more = gap_at(b, t, up), less = gap_at(b, t, down);
      EXPECT_NEAR((more.gap - less.gap) / 2e-5, g.normal[c], 1e-2);
      for (int r = 0; r < 3; ++r) turn(r, c) = (more.normal[r] - less.normal[r]) / 2e-5;
    }
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR((turn(r, c) + turn(c, r)) / 2, g.bend(r, c), 1e-8);
  }
}

TEST(CurvedGap, GoesOnFromTriangleToTriangle) {
  const RigidSurface b = ball(2);
  for (int t = 0; t < static_cast<int>(b.facets.triangles.size()); ++t) {
    const int next = b.facets.neighbours[t][0];
    const Vec3<double> x = above(b, t, {0, .4, .6}, -.01);
    const FaceGap here = gap_at(b, t, x), there = gap_at(b, next, x);
    EXPECT_NEAR(here.gap, there.gap, 2e-5);
    EXPECT_GT(dot(here.normal, there.normal), 1 - 1e-5);
  }
}

TEST(CornerNormals, LeaveAFlatFaceBesideARoundedEdgeFlat) {
  RigidBodySpec spec;
  spec.band = BandShape{.edge_facets = 12};
  spec.band->arc.facets = 200;
  const RigidSurface band = make_rigid_surface("band", spec, "rigid_bodies.band");
  int flat = 0;
  for (std::size_t t = 0; t < band.facets.triangles.size(); ++t) {
    const Triangle c = corners_of(band, static_cast<int>(t));
    double width = 0;
    for (int i = 0; i < 3; ++i) width = std::max(width, std::abs(c[i][2] - c[(i + 1) % 3][2]));
    if (width < 1) continue;  // the inner and outer faces reach from edge to edge
    ++flat;
    for (const auto& n : band.normals[t]) EXPECT_LT(std::abs(n[2]), 0.01);
  }
  EXPECT_GT(flat, 100);
}

TEST(CornerNormals, KeepSharpEdges) {
  RigidBodySpec spec;
  spec.cylinder = RodShape{.radius = 1, .length = 2, .facets = 48};
  const RigidSurface rod = make_rigid_surface("rod", spec, "rigid_bodies.rod");
  ASSERT_GT(rod.facets.triangles.size(), 48u);
  for (std::size_t t = 0; t < rod.facets.triangles.size(); ++t)
    for (const auto& n : rod.normals[t]) EXPECT_TRUE(std::abs(n[2]) < 1e-9 || std::abs(n[2]) > 1 - 1e-9);
}

}  // namespace
}  // namespace bulbus
