#include "contact/search/nearest_point.hpp"

namespace bulbus::inline contact {
namespace {

std::array<double, 3> nearest_weights(const Vec3<double>& x, const Triangle& v) {
  const Vec3<double> ab = minus(v[1], v[0]), ac = minus(v[2], v[0]), ax = minus(x, v[0]), bx = minus(x, v[1]),
                     cx = minus(x, v[2]);
  const double d1 = dot(ab, ax), d2 = dot(ac, ax), d3 = dot(ab, bx), d4 = dot(ac, bx), d5 = dot(ab, cx),
               d6 = dot(ac, cx);
  if (d1 <= 0 && d2 <= 0) return {1, 0, 0};
  if (d3 >= 0 && d4 <= d3) return {0, 1, 0};
  if (d6 >= 0 && d5 <= d6) return {0, 0, 1};
  const double c = d1 * d4 - d3 * d2, b = d5 * d2 - d1 * d6, a = d3 * d6 - d5 * d4;
  if (c <= 0 && d1 >= 0 && d3 <= 0) return {1 - d1 / (d1 - d3), d1 / (d1 - d3), 0};
  if (b <= 0 && d2 >= 0 && d6 <= 0) return {1 - d2 / (d2 - d6), 0, d2 / (d2 - d6)};
  if (a <= 0 && d4 >= d3 && d5 >= d6) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0, 1 - t, t};
  }
  const double sum = a + b + c;
  return {a / sum, b / sum, c / sum};
}

}  // namespace

NearestPoint nearest_point(const Vec3<double>& x, const Triangle& corners) {
  const auto w = nearest_weights(x, corners);
  Vec3<double> r = x;
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) r[c] -= w[i] * corners[i][c];
  return {w, norm(r)};
}

}  // namespace bulbus::inline contact
