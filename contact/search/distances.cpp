#include "contact/search/distances.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "contact/search/nearest_point.hpp"
#include "contact/search/position_codes.hpp"

namespace bulbus::inline contact {

namespace {

constexpr int at_once = 256;  // points: far ones have thousands of candidates each

// Distances of some of the points, where they are at most `reach`. Returns the others.
std::vector<int> within(double reach, std::span<const int> of, std::span<const double> points,
                        const MasterSurface& surface, std::span<double> distance) {
  std::vector<double> places;
  for (int i : of) places.insert(places.end(), &points[3 * i], &points[3 * i] + 3);
  const Candidates near = find_candidates(places, surface.facets.triangles, surface.places, reach);
  std::vector<int> rest;
  for (int k = 0; k < static_cast<int>(of.size()); ++k) {
    double& d = distance[of[k]];
    for (int t : near.of(k)) d = std::min(d, nearest_point(at(places, k), surface.corners(t)).distance);
    if (d > reach) rest.push_back(of[k]);
  }
  return rest;
}

}  // namespace

// Points that nothing is near look twice as far in the next round.
std::vector<double> distances(std::span<const double> points, const MasterSurface& surface, double farthest) {
  std::vector<double> distance(points.size() / 3, INFINITY);
  std::vector<int> open(distance.size());
  std::iota(open.begin(), open.end(), 0);
  for (double reach = farthest / 16; reach <= farthest && !open.empty(); reach *= 2) {
    std::vector<int> rest;
    for (std::size_t first = 0; first < open.size(); first += at_once) {
      const auto some =
          within(reach, std::span(open).subspan(first, std::min<std::size_t>(at_once, open.size() - first)),
                 points, surface, distance);
      rest.insert(rest.end(), some.begin(), some.end());
    }
    open = std::move(rest);
  }
  for (int i : open) distance[i] = INFINITY;
  return distance;
}

double distance(const Vec3<double>& point, const MasterSurface& surface) {
  double nearest = INFINITY;
  for (int t = 0; t < static_cast<int>(surface.facets.triangles.size()); ++t) {
    const auto& [center, radius] = surface.sphere(t);
    if (norm(minus(center, point)) - radius < nearest)
      nearest = std::min(nearest, nearest_point(point, surface.corners(t)).distance);
  }
  return nearest;
}

}  // namespace bulbus::inline contact
