#include "contact/surfaces/pair.hpp"

#include <cmath>

namespace bulbus::inline contact {

double angle_at(const Triangle& v, int i) {
  const Vec3<double> a = minus(v[(i + 1) % 3], v[i]), b = minus(v[(i + 2) % 3], v[i]);
  return std::atan2(norm(cross(a, b)), dot(a, b));
}

Pair project(const Vec3<double>& x, const Triangle& corners) {
  const Vec3<double> e1 = minus(corners[1], corners[0]), e2 = minus(corners[2], corners[0]),
                     r = minus(x, corners[0]);
  Vec3<double> n = cross(e1, e2);
  const double j = norm(n);
  for (double& v : n) v /= j;
  Vec3<double> t1 = cross(e2, n), t2 = cross(n, e1);
  for (double& v : t1) v /= j;
  for (double& v : t2) v /= j;
  const double L2 = dot(t1, r), L3 = dot(t2, r);
  return {dot(r, n), n, {1 - L2 - L3, L2, L3}};
}

}  // namespace bulbus::inline contact
