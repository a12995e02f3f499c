#include "core/mesh/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/base/error.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus {
namespace {

/// The neighbours of each corner along ξ, η, ζ, ordered so that a cube gives +1.
constexpr std::array<std::array<int, 3>, 8> edges{
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

double at_corner(const std::array<Point, 8>& x, int a) {
  const Point u = x[edges[a][0]] - x[a], v = x[edges[a][1]] - x[a], w = x[edges[a][2]] - x[a];
  const double lengths = norm(u) * norm(v) * norm(w);
  return lengths > 0 ? dot(u, cross(v, w)) / lengths : 0;
}

void summarise(RegionQuality& q, std::vector<double> values) {
  q.count = static_cast<int>(values.size());
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  q.least = values.front();
  q.five_percent = values[static_cast<std::size_t>(.05 * (values.size() - 1))];
  q.mean = std::accumulate(values.begin(), values.end(), 0.0) / values.size();
}

}  // namespace

double scaled_jacobian(const Mesh& mesh, int hex) {
  const std::array<Point, 8> x = corners(mesh, hex);
  double least = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 8; ++a) least = std::min(least, at_corner(x, a));
  return least;
}

std::vector<RegionQuality> quality(const Mesh& mesh) {
  std::vector<RegionQuality> result(mesh.region_names.size());
  std::vector<std::vector<double>> values(result.size());
  for (std::size_t e = 0; e < mesh.hexes.size(); ++e) {
    values[mesh.region[e]].push_back(scaled_jacobian(mesh, e));
    result[mesh.region[e]].volume += hex_volume(mesh, e);
  }
  for (std::size_t r = 0; r < result.size(); ++r) {
    result[r].region = mesh.region_names[r];
    summarise(result[r], std::move(values[r]));
  }
  return result;
}

void refuse_inverted(const Mesh& mesh) {
  for (std::size_t e = 0; e < mesh.hexes.size(); ++e) {
    const double q = scaled_jacobian(mesh, e);
    if (q > 0) continue;
    const Point c = center(mesh, e);
    throw input_error(
        fmt::format(
            "hexahedron {} of region '{}' about ({:.4g}, {:.4g}, {:.4g}) mm is inside out or flat (scaled "
            "Jacobian {:.3g})",
            e + 1, mesh.region_names[mesh.region[e]], c[0], c[1], c[2], q),
        "smooth or refine the mesh there");
  }
}

}  // namespace bulbus
