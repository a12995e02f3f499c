#include "contact/search/sweep.hpp"

#include <algorithm>

#include "contact/search/nearest_point.hpp"

namespace bulbus {
namespace {

constexpr double beside = 0.05;  // weights: what a crossing may miss a triangle by
constexpr int longest_walk = 64;

bool degenerate(const Triangle& v) { return !(norm(cross(minus(v[1], v[0]), minus(v[2], v[0]))) > 0); }

}  // namespace

int entered_through(const MasterSurface& now, std::span<const double> before, const Way& way,
                    std::span<const int> candidates, double on_surface) {
  int first = -1;
  double earliest = 2;
  for (int t : candidates) {
    const Triangle end = now.corners(t);
    if (dot(minus(way.to, end[0]), cross(minus(end[1], end[0]), minus(end[2], end[0]))) >= 0) continue;
    const Triangle start = corners_of(now.facets, before, t);
    if (degenerate(start) || degenerate(end)) continue;
    const Pair p0 = project(way.from, start), p1 = project(way.to, end);
    if (p0.gap < -on_surface || p1.gap >= -on_surface) continue;
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
  for (int step = 0; step < longest_walk && std::ranges::min(p.weights) < 0; ++step) {
    const int next = master.facets.neighbours[t][std::ranges::min_element(p.weights) - p.weights.begin()];
    if (next < 0 || next == before) break;
    const double there = nearest_point(x, master.corners(next)).distance;
    if (there > distance * (1 + 1e-12)) break;
    before = t, t = next, distance = there;
    p = project(x, master.corners(t));
  }
  return t;
}

}  // namespace bulbus
