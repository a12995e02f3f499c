#include "contact/search/sweep.hpp"

#include <algorithm>

#include "contact/search/nearest_point.hpp"

namespace bulbus::inline contact {
namespace {

constexpr double beside = 0.05;   // weights: what a crossing may miss a triangle by
constexpr int longest_path = 64;  // triangles: guards against a ring of them

// Distance to the plane of a triangle times the length of its normal, which is not a unit vector.
struct Side {
  Vec3<double> normal;
  double distance;
  Side(const Vec3<double>& x, const Triangle& v)
      : normal(cross(minus(v[1], v[0]), minus(v[2], v[0]))), distance(dot(minus(x, v[0]), normal)) {}
  bool degenerate() const { return !(dot(normal, normal) > 0); }
  bool behind(double tolerance) const {
    return distance < 0 && distance * distance > tolerance * tolerance * dot(normal, normal);
  }
};

}  // namespace

// Both have moved, and the crossing may lie a little beside a triangle, whose radius may have been larger on
// the way by twice the motion.
double farthest_crossing(const MasterSurface& now, double motion, const Way& way) {
  return norm(minus(way.to, way.from)) + motion + 4 * beside * (now.spheres->largest_radius + 2 * motion);
}

int entered_through(const MasterSurface& now, std::span<const double> before, double motion, const Way& way,
                    std::span<const int> candidates, double on_surface, double rise) {
  int first = -1;
  double earliest = 2;
  const double beyond = norm(minus(way.to, way.from)) + 3 * motion;
  for (int t : candidates) {
    const auto& [center, radius] = now.sphere(t);
    const Vec3<double> r = minus(center, way.to);
    const double reach = beyond + (1 + 4 * beside) * radius;
    if (dot(r, r) > reach * reach) continue;
    const Triangle end = now.corners(t);
    const Side after(way.to, end);
    if (after.distance >= 0 || after.degenerate()) continue;
    const Triangle start = corners_of(now.facets, before, t);
    if (const Side was(way.from, start); was.degenerate() || was.behind(on_surface + rise)) continue;
    const Pair p0 = project(way.from, start), p1 = project(way.to, end);
    if (p0.gap < -on_surface - rise || p1.gap >= -on_surface) continue;
    const double part = std::max(0., p0.gap) / (std::max(0., p0.gap) - p1.gap);
    if (part >= earliest) continue;
    const auto inside = [&](int i) { return (1 - part) * p0.weights[i] + part * p1.weights[i] >= -beside; };
    if (inside(0) && inside(1) && inside(2)) first = t, earliest = part;
  }
  return first;
}

int nearest_from(const MasterSurface& master, const Vec3<double>& x, int start) {
  int t = start, before = -1;
  Pair p = project(x, master.corners(t));
  double distance = nearest_point(x, master.corners(t)).distance;
  for (int step = 0; step < longest_path && std::ranges::min(p.weights) < 0; ++step) {
    const int next = master.facets.neighbours[t][std::ranges::min_element(p.weights) - p.weights.begin()];
    if (next < 0 || next == before) break;
    const double there = nearest_point(x, master.corners(next)).distance;
    if (there > distance * (1 + 1e-12)) break;
    before = t, t = next, distance = there;
    p = project(x, master.corners(t));
  }
  return t;
}

}  // namespace bulbus::inline contact
