#pragma once
#include "contact/rigid/rigid_shapes.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus {

inline RigidSurface body(const RigidBodySpec& spec) {
  return make_rigid_surface("b", spec, "rigid_bodies.b");
}

/// A triangle of a body where it is now.
struct Facet {
  std::array<Vec3<double>, 3> corners;
  Vec3<double> normal, middle;
  double area;
  Facet(const RigidSurface& b, int t) {
    for (int i = 0; i < 3; ++i)
      for (int c = 0; c < 3; ++c) corners[i][c] = b.places[3 * b.facets.triangles[t][i] + c];
    const Vec3<double> n = cross(corners[1] - corners[0], corners[2] - corners[0]);
    area = norm(n) / 2;
    normal = (.5 / area) * n;
    middle = (1. / 3) * (corners[0] + corners[1] + corners[2]);
  }
};

/// Solid angle of a closed surface over 4π: 1 inside, 0 outside (van Oosterom and Strackee 1983).
inline double winding(const RigidSurface& b, const Vec3<double>& x) {
  double sum = 0;
  for (int t = 0; t < static_cast<int>(b.facets.triangles.size()); ++t) {
    const Facet f(b, t);
    std::array<Vec3<double>, 3> r;
    for (int i = 0; i < 3; ++i) r[i] = f.corners[i] - x;
    const double a = norm(r[0]), c = norm(r[1]), d = norm(r[2]);
    sum += std::atan2(dot(r[0], cross(r[1], r[2])),
                      a * c * d + dot(r[0], r[1]) * d + dot(r[1], r[2]) * a + dot(r[2], r[0]) * c);
  }
  return sum / (2 * std::acos(-1.));
}

}  // namespace bulbus
