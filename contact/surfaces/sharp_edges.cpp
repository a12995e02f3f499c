#include "contact/surfaces/sharp_edges.hpp"

#include <algorithm>

#include "contact/search/local_search.hpp"
#include "contact/surfaces/meridians.hpp"
#include "contact/surfaces/smoothed_facets.hpp"

namespace bulbus::inline contact {
namespace {

struct Plane {
  Vec3<double> middle, normal;
};

Plane plane_of(const Triangle& v) { return {centroid(v), unit(cross(minus(v[1], v[0]), minus(v[2], v[0])))}; }

bool behind(const Plane& a, const Plane& b) { return dot(minus(a.middle, b.middle), b.normal) < 0; }

}  // namespace

SharpEdges::SharpEdges(const Facets& facets, std::span<const double> places, Kind kind) {
  const bool convex = kind == Kind::convex;
  const int n = static_cast<int>(facets.triangles.size());
  std::vector<Plane> planes;
  std::vector<std::vector<int>> around(places.size() / 3);
  for (int t = 0; t < n; ++t) {
    planes.push_back(plane_of(corners_of(facets, places, t)));
    for (int corner : facets.triangles[t]) around[corner].push_back(t);
  }
  start_.push_back(0);
  for (int t = 0; t < n; ++t) {
    for (int corner : facets.triangles[t])
      for (int other : around[corner])
        if (dot(planes[t].normal, planes[other].normal) < smooth_edge &&
            behind(planes[t], planes[other]) == convex && behind(planes[other], planes[t]) == convex)
          others_.push_back(other);
    const auto first = others_.begin() + start_.back();
    std::sort(first, others_.end());
    others_.erase(std::unique(first, others_.end()), others_.end());
    start_.push_back(static_cast<int>(others_.size()));
  }
}

}  // namespace bulbus::inline contact
