#include "contact/distances.hpp"

#include <algorithm>
#include <numeric>

#include "contact/nearest_point.hpp"
#include "contact/position_codes.hpp"

namespace bulbus {

// Points that nothing is near look twice as far in the next round.
std::vector<double> distances(std::span<const double> points, const MasterSurface& surface, double farthest) {
  std::vector<double> distance(points.size() / 3, farthest);
  std::vector<int> open(distance.size());
  std::iota(open.begin(), open.end(), 0);
  for (double reach = farthest / 16; reach <= farthest && !open.empty(); reach *= 2) {
    std::vector<double> places;
    for (int i : open) places.insert(places.end(), &points[3 * i], &points[3 * i] + 3);
    const Candidates near = find_candidates(places, surface.facets.triangles, surface.places, reach);
    std::vector<int> rest;
    for (int k = 0; k < static_cast<int>(open.size()); ++k) {
      double& d = distance[open[k]];
      for (int t : near.of(k))
        d = std::min(d, nearest_point({places[3 * k], places[3 * k + 1], places[3 * k + 2]}, surface.corners(t)).distance);
      if (d > reach) rest.push_back(open[k]);
    }
    open = std::move(rest);
  }
  return distance;
}

}  // namespace bulbus
