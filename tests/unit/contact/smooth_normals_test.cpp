#include "contact/smooth_normals.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/rigid_shapes.hpp"

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

TEST(SmoothNormals, OfABallPointAwayFromItsCentreAndBendByItsRadius) {
  const RigidSurface b = ball(2);
  const int triangles = static_cast<int>(b.facets.triangles.size());
  double mean = 0;
  for (int t = 0; t < triangles; ++t) {
    const Triangle c = corners_of(b, t);
    Vec3<double> x{0, 0, 0};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) x[k] += c[i][k] / 3;
    const SmoothNormal s = smooth_normal(project(x, c), b.normals[t]);
    EXPECT_NEAR(dot(s.normal, x) / norm(x), 1, 1e-4);
    EXPECT_NEAR(trace(s.bend), 2 / 2., 0.2);  // one triangle sees it roughly, all together well
    mean += trace(s.bend) / triangles;
    for (int r = 0; r < 3; ++r)  // nothing along the normal
      EXPECT_NEAR(s.bend(r, 0) * s.normal[0] + s.bend(r, 1) * s.normal[1] + s.bend(r, 2) * s.normal[2], 0, 1e-12);
  }
  EXPECT_NEAR(mean, 2 / 2., 0.02);
}

TEST(SmoothNormals, DoNotBendBeyondTheTriangle) {
  const RigidSurface b = ball(2);
  const Triangle c = corners_of(b, 5);
  Vec3<double> x;
  for (int k = 0; k < 3; ++k) x[k] = 2 * c[0][k] - c[1][k];
  EXPECT_EQ(trace(smooth_normal(project(x, c), b.normals[5]).bend), 0);
}

TEST(SmoothNormals, LeaveAFlatFaceBesideARoundedEdgeFlat) {
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

TEST(SmoothNormals, KeepSharpEdges) {
  RigidBodySpec spec;
  spec.cylinder = RodShape{.radius = 1, .length = 2, .facets = 48};
  const RigidSurface rod = make_rigid_surface("rod", spec, "rigid_bodies.rod");
  for (std::size_t t = 0; t < rod.facets.triangles.size(); ++t)
    for (const auto& n : rod.normals[t]) EXPECT_TRUE(std::abs(n[2]) < 1e-9 || std::abs(n[2]) > 1 - 1e-9);
}

}  // namespace
}  // namespace bulbus
