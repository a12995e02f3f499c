#include "contact/search/local_search.hpp"

#include <algorithm>
#include <cmath>

#include "contact/search/nearest_point.hpp"

namespace bulbus::inline contact {
namespace {

constexpr double on_edge = 1e-9;  // weights: what is round-off of an edge
constexpr double away = -1e-6;    // N·n above this: not facing
constexpr int longest_walk = 20;  // triangles from the last one: guards against a ring of them

// Differences below round-off do not decide between triangles: the lower number does, it comes first.
bool nearer(double a, double b, const SearchLimits& limits) { return a < b - 1e-9 * limits.reach; }

// Does the line x + d N miss the sphere, with room for round-off?
bool passes_by(const Vec3<double>& x, const Vec3<double>& N, const EnclosingSpheres::Sphere& s) {
  const Vec3<double> r = minus(s.center, x);
  const double along = dot(r, N);
  return dot(r, r) - along * along > 1.05 * s.radius * s.radius;
}

struct Hit {
  int triangle = -1;
  double distance = 0;  // along the line
};

Hit line_hit(const MasterSurface& master, const Vec3<double>& x, const Vec3<double>& N, int start,
             std::span<const int> candidates, const SearchLimits& limits) {
  if (start >= 0)
    if (const int t = track(master, x, N, start); t >= 0)
      if (const double d = cross_line(x, N, master.corners(t)).distance; std::abs(d) <= limits.reach)
        return {t, d};
  Hit best;
  for (int t : candidates) {
    if (passes_by(x, N, master.sphere(t))) continue;
    const Triangle corners = master.corners(t);
    const Crossing c = cross_line(x, N, corners);
    if (!c.facing || !c.inside(master.facets.neighbours[t], master.rim) ||
        std::abs(c.distance) > limits.reach)
      continue;
    if (best.triangle >= 0 && !nearer(std::abs(c.distance), std::abs(best.distance), limits)) continue;
    if (project(x, corners).gap > -limits.depth) best = {t, c.distance};
  }
  return best;
}

bool farther(const Vec3<double>& x, const EnclosingSpheres::Sphere& s, double distance) {
  const Vec3<double> r = minus(s.center, x);
  return dot(r, r) > (distance + s.radius) * (distance + s.radius);
}

// The triangles around a nearest point, with the weights of their normals; none at a rim.
struct Around {
  std::vector<int> triangles;
  std::vector<double> shares;
};

Around around(const MasterSurface& master, int triangle, const std::array<double, 3>& weights,
              std::span<const int> candidates) {
  const Facets& f = master.facets;
  const auto zeros = std::ranges::count(weights, 0.);
  if (zeros == 0) return {{triangle}, {1}};
  if (zeros == 1) {
    const int other = f.neighbours[triangle][std::ranges::find(weights, 0.) - weights.begin()];
    if (other < 0) return {};
    return {{triangle, other}, {1, 1}};
  }
  const int corner = f.triangles[triangle][std::ranges::max_element(weights) - weights.begin()];
  Around fan;
  for (int t : candidates) {
    const auto& nodes = f.triangles[t];
    const int i = static_cast<int>(std::ranges::find(nodes, corner) - nodes.begin());
    if (i == 3) continue;
    if (f.neighbours[t][(i + 1) % 3] < 0 || f.neighbours[t][(i + 2) % 3] < 0) return {};
    fan.triangles.push_back(t);
    fan.shares.push_back(angle_at(master.corners(t), i));
  }
  return fan;
}

}  // namespace

EnclosingSpheres::EnclosingSpheres(const Facets& facets, std::span<const double> places) {
  of_each.reserve(facets.triangles.size());
  for (int t = 0; t < static_cast<int>(facets.triangles.size()); ++t) {
    const Triangle v = corners_of(facets, places, t);
    Sphere s{centroid(v), 0};
    for (const auto& corner : v) s.radius = std::max(s.radius, norm(minus(corner, s.center)));
    of_each.push_back(s);
    largest_radius = std::max(largest_radius, s.radius);
  }
}

MasterSurface::MasterSurface(const Facets& f, std::span<const double> p, std::span<const CornerNormals> n,
                             std::shared_ptr<const EnclosingSpheres> s)
    : facets(f),
      places(p),
      normals(n),
      spheres(s ? std::move(s) : std::make_shared<const EnclosingSpheres>(f, p)) {}

bool Crossing::inside(const std::array<int, 3>& neighbours, double rim) const {
  for (int i = 0; i < 3; ++i)
    if (!(weights[i] >= (neighbours[i] < 0 ? -std::max(rim, on_edge) : -on_edge))) return false;
  return true;
}

Crossing cross_line(const Vec3<double>& x, const Vec3<double>& N, const Triangle& corners) {
  const Vec3<double> A = minus(corners[0], x), B = minus(corners[1], x), C = minus(corners[2], x);
  const Vec3<double> normal = cross(minus(B, A), minus(C, A));
  const double sum = dot(N, normal);
  if (!(sum < away * norm(normal))) return {};
  const Vec3<double> BC = cross(B, C);
  return {true, {dot(N, BC) / sum, dot(N, cross(C, A)) / sum, dot(N, cross(A, B)) / sum}, dot(A, BC) / sum};
}

int track(const MasterSurface& master, const Vec3<double>& x, const Vec3<double>& N, int start) {
  for (int t = start, step = 0; t >= 0 && step < longest_walk; ++step) {
    const Crossing c = cross_line(x, N, master.corners(t));
    if (!c.facing) return -1;
    if (c.inside(master.facets.neighbours[t], master.rim)) return t;
    t = master.facets.neighbours[t][std::ranges::min_element(c.weights) - c.weights.begin()];
  }
  return -1;
}

int triangle_of_projection(const MasterSurface& master, const Vec3<double>& x, int start) {
  int t = start, before = -1;
  Pair flat = project(x, master.corners(t));
  for (int step = 0; step < longest_walk; ++step) {
    const auto projection = project_along_normals(x, flat, master.corners(t), master.normals[t]);
    const auto& weights = projection ? projection->weights : flat.weights;
    if (std::ranges::min(weights) >= -on_edge) break;
    const int next = master.facets.neighbours[t][std::ranges::min_element(weights) - weights.begin()];
    if (next < 0 || next == before) break;
    const Pair there = project(x, master.corners(next));
    if (master.edges && dot(flat.normal, there.normal) < smooth_edge) break;
    before = t, t = next, flat = there;
  }
  return t;
}

Selection select(const MasterSurface& master, const Vec3<double>& x, const Vec3<double>& N, int start,
                 std::span<const int> candidates, const SearchLimits& limits) {
  const Hit hit = line_hit(master, x, N, start, candidates, limits);
  if (hit.triangle >= 0 && hit.distance <= 0) return {hit.triangle, -hit.distance};
  const Selection on_line{hit.triangle, hit.triangle >= 0 ? hit.distance : limits.reach};

  int nearest = -1;
  NearestPoint projection{{}, on_line.distance};
  for (int t : candidates) {
    if (farther(x, master.sphere(t), projection.distance)) continue;
    if (const NearestPoint p = nearest_point(x, master.corners(t));
        nearer(p.distance, projection.distance, limits))
      nearest = t, projection = p;
  }
  if (nearest < 0) return on_line;
  const Around ring = around(master, nearest, projection.weights, candidates);
  double side = 0, most_opposed = away;
  int chosen = -1;
  for (std::size_t i = 0; i < ring.triangles.size(); ++i) {
    const Pair p = project(x, master.corners(ring.triangles[i]));
    side += ring.shares[i] * p.gap;
    if (const double facing = dot(N, p.normal); facing < most_opposed && p.gap < 0 && p.gap > -limits.depth)
      most_opposed = facing, chosen = ring.triangles[i];
  }
  if (side < 0 && chosen >= 0) return {chosen, projection.distance};
  return {on_line.triangle, projection.distance};
}

}  // namespace bulbus::inline contact
