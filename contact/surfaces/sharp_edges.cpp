#include "contact/surfaces/sharp_edges.hpp"

#include <algorithm>
#include <cmath>

#include "contact/search/local_search.hpp"
#include "contact/surfaces/meridians.hpp"
#include "contact/surfaces/smoothed_facets.hpp"
#include "core/problem/closed_surface.hpp"

namespace bulbus::inline contact {
namespace {

struct Plane {
  Vec3<double> middle, normal;
};

Plane plane_of(const Triangle& v) { return {centroid(v), unit(cross(minus(v[1], v[0]), minus(v[2], v[0])))}; }

bool behind(const Plane& a, const Plane& b) { return dot(minus(a.middle, b.middle), b.normal) < 0; }

// Of each triangle: do all of its corners lie in one of the planes of symmetry?
std::vector<bool> in_plane(const Facets& facets, std::span<const double> places,
                           std::span<const std::string> symmetry) {
  double size = 0;
  for (double x : places) size = std::max(size, std::abs(x));
  std::vector<bool> flat;
  for (const auto& triangle : facets.triangles)
    flat.push_back(std::ranges::any_of(symmetry, [&](const std::string& plane) {
      return std::ranges::all_of(
          triangle, [&](int p) { return std::abs(places[3 * p + axis_of(plane)]) <= 1e-9 * size; });
    }));
  return flat;
}

}  // namespace

SharpEdges::SharpEdges(const Facets& facets, std::span<const double> places, Kind kind,
                       std::span<const std::string> symmetry) {
  const bool convex = kind == Kind::convex;
  const int n = static_cast<int>(facets.triangles.size());
  const std::vector<bool> goes_on = in_plane(facets, places, symmetry);
  std::vector<Plane> planes;
  std::vector<std::vector<int>> around(places.size() / 3);
  for (int t = 0; t < n; ++t) {
    planes.push_back(plane_of(corners_of(facets, places, t)));
    for (int corner : facets.triangles[t])
      if (!goes_on[t]) around[corner].push_back(t);
  }
  start_.push_back(0);
  for (int t = 0; t < n; ++t) {
    for (int corner : facets.triangles[t])
      for (int other : around[corner])
        if (!goes_on[t] && dot(planes[t].normal, planes[other].normal) < smooth_edge &&
            behind(planes[t], planes[other]) == convex && behind(planes[other], planes[t]) == convex)
          others_.push_back(other);
    const auto first = others_.begin() + start_.back();
    std::sort(first, others_.end());
    others_.erase(std::unique(first, others_.end()), others_.end());
    start_.push_back(static_cast<int>(others_.size()));
  }
}

}  // namespace bulbus::inline contact
