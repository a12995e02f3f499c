#include "contact/rigid/convex_outline.hpp"

#include <algorithm>
#include <cmath>

namespace bulbus::inline contact {
namespace {

double size_of(std::span<const Point2> points) {
  double size = 0;
  for (const Point2& p : points) size = std::max(size, std::hypot(p[0] - points[0][0], p[1] - points[0][1]));
  return size;
}

// Left of every edge, or closer to it than rounding.
bool inside_or_on(std::span<const Point2> hull, const Point2& S) {
  const double near = 1e-9 * size_of(hull);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    if (turn(a, b, S) < -near * std::hypot(b[0] - a[0], b[1] - a[1])) return false;
  }
  return true;
}

// Andrew's monotone chain: counter-clockwise, without collinear corners.
std::vector<Point2> convex_hull(std::vector<Point2> points) {
  std::ranges::sort(points);
  if (points.empty()) return {};
  const double tolerance = 1e-12 * size_of(points) * size_of(points);
  std::vector<Point2> hull;
  const auto chain = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), *p) <= tolerance)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();  // the other chain begins there
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return hull.size() < 3 ? std::vector<Point2>{} : hull;
}

}  // namespace

std::vector<Point2> convex_outline(const RigidSurface& body, const CuttingPlane& plane) {
  std::vector<Point2> points;
  for (const CutSegment& s : cut(body.places, body.facets.triangles, plane))
    if (s.ends[0][1] + s.ends[1][1] > 0) points.insert(points.end(), s.ends.begin(), s.ends.end());
  return convex_hull(std::move(points));
}

std::optional<Tangent> outer_tangent(std::span<const Point2> hull, const Point2& S) {
  if (hull.size() < 3 || inside_or_on(hull, S)) return {};
  Point2 middle{0, 0};
  for (const Point2& p : hull)
    for (int c = 0; c < 2; ++c) middle[c] += p[c] / static_cast<double>(hull.size());
  std::optional<Tangent> best;
  double outwards = 0;
  for (const double side : {1., -1.}) {  // all of the hull to the left of S → T, or to the right
    Point2 T = hull[0];
    for (const Point2& p : hull) {
      const double far = std::hypot(p[0] - S[0], p[1] - S[1]), reach = std::hypot(T[0] - S[0], T[1] - S[1]);
      const double sine = side * turn(S, T, p) / (far * reach);
      if (sine < -1e-12 || (sine < 1e-12 && far < reach)) T = p;
    }
    const double length = std::hypot(T[0] - S[0], T[1] - S[1]);
    const Point2 d{(T[0] - S[0]) / length, (T[1] - S[1]) / length},
        away{side * d[1], -side * d[0]};  // away from the hull
    if (const double out = away[0] * middle[0] + away[1] * middle[1]; !best || out > outwards) {
      best = {T, d, length};
      outwards = out;
    }
  }
  return best;
}

}  // namespace bulbus::inline contact
