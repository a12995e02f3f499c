#include "core/mesh/quality.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/base/error.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus::inline mesh {
namespace {

/// The neighbours of each corner along ξ, η, ζ, ordered so that a cube gives +1.
constexpr std::array<std::array<int, 3>, 8> edges{
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

double at_corner(const std::array<Point, 8>& x, int a) {
  const Point u = x[edges[a][0]] - x[a], v = x[edges[a][1]] - x[a], w = x[edges[a][2]] - x[a];
  const double lengths = norm(u) * norm(v) * norm(w);
  return lengths > 0 ? dot(u, cross(v, w)) / lengths : 0;
}

std::array<Point, 8> corners(const LocalMesh& mesh, int hex) {
  std::array<Point, 8> x;
  for (int a = 0; a < 8; ++a) std::copy_n(&mesh.X[3 * mesh.hexes[hex][a]], 3, x[a].begin());
  return x;
}

double scaled_jacobian(const std::array<Point, 8>& x) {
  double least = std::numeric_limits<double>::infinity();
  for (int a = 0; a < 8; ++a) least = std::min(least, at_corner(x, a));
  return least;
}

// The value of that rank among the sorted values of all ranks, by bisection of the numbers between −1 and 1.
double selected(const std::vector<double>& sorted, long long rank, const Comm& comm) {
  double low = -2, high = 2;  // at most `rank` values are ≤ low, more are ≤ high
  while (true) {
    const double middle = std::midpoint(low, high);
    if (middle <= low || middle >= high) return high;
    const auto below = std::ranges::upper_bound(sorted, middle) - sorted.begin();
    (comm.sum(static_cast<long long>(below)) > rank ? high : low) = middle;
  }
}

void summarise(RegionQuality& q, std::vector<double> values, const Comm& comm) {
  const auto count = comm.sum(static_cast<long long>(values.size()));
  q.count = static_cast<int>(count);
  q.volume = comm.sum(q.volume);
  if (count == 0) return;
  std::sort(values.begin(), values.end());
  q.least = comm.min(values.empty() ? std::numeric_limits<double>::infinity() : values.front());
  q.five_percent = selected(values, static_cast<long long>(.05 * static_cast<double>(count - 1)), comm);
  q.mean = comm.sum(std::accumulate(values.begin(), values.end(), 0.0)) / static_cast<double>(count);
}

Point center(const std::array<Point, 8>& x) {
  Point c{};
  for (const Point& p : x) c = c + .125 * p;
  return c;
}

// What is not a number is worst.
double comparable(double quality) { return std::isnan(quality) ? -2 : quality; }

void sort_and_cut(std::vector<PoorCell>& cells) {
  std::ranges::sort(cells, {}, [](const PoorCell& c) { return std::pair(c.quality, c.number); });
  if (cells.size() > PoorCells::most_listed) cells.resize(PoorCells::most_listed);
}

void refuse(const PoorCells& inverted, const std::vector<std::string>& regions) {
  const PoorCell& first = inverted.worst[0];
  std::string others =
      inverted.count > 1 ? fmt::format("; so are {} others, worst first:", inverted.count - 1) : "";
  for (std::size_t i = 1; i < inverted.worst.size(); ++i)
    others += fmt::format("{} {} ({:.3g})", i > 1 ? "," : "", inverted.worst[i].number + 1,
                          inverted.worst[i].quality);
  if (inverted.count > std::ssize(inverted.worst)) others += ", ...";
  throw input_error(fmt::format("hexahedron {} of region '{}' about ({:.4g}, {:.4g}, {:.4g}) mm is inside "
                                "out or flat (scaled Jacobian {:.3g}){}",
                                first.number + 1, regions[first.region], first.center[0], first.center[1],
                                first.center[2], first.quality, others),
                    "smooth or refine the mesh there");
}

}  // namespace

double scaled_jacobian(const Mesh& mesh, int hex) { return scaled_jacobian(corners(mesh, hex)); }

std::vector<RegionQuality> quality(const Mesh& mesh) {
  std::vector<RegionQuality> result(mesh.region_names.size());
  std::vector<std::vector<double>> values(result.size());
  for (std::size_t e = 0; e < mesh.hexes.size(); ++e) {
    values[mesh.region[e]].push_back(scaled_jacobian(mesh, e));
    result[mesh.region[e]].volume += hex_volume(mesh, e);
  }
  for (std::size_t r = 0; r < result.size(); ++r) {
    result[r].region = mesh.region_names[r];
    summarise(result[r], std::move(values[r]), Comm(MPI_COMM_SELF));
  }
  return result;
}

std::vector<RegionQuality> quality(const LocalMesh& mesh) {
  std::vector<RegionQuality> result;
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    RegionQuality q{.region = mesh.region_names[r]};
    std::vector<double> values;
    const auto [first, count] = mesh.regions[r];
    values.reserve(count);
    for (int h = first; h < first + count; ++h) {
      const auto x = corners(mesh, h);
      values.push_back(scaled_jacobian(x));
      q.volume += hex_volume(x);
    }
    summarise(q, std::move(values), mesh.comm);
    result.push_back(q);
  }
  return result;
}

PoorCells poor_cells(const LocalMesh& mesh, double limit) {
  PoorCells poor;
  for (int r = 0; r < std::ssize(mesh.regions); ++r)
    for (int h = mesh.regions[r].first; h < mesh.regions[r].first + mesh.regions[r].count; ++h) {
      const auto x = corners(mesh, h);
      if (const double q = comparable(scaled_jacobian(x)); q <= limit)
        poor.worst.push_back({q, mesh.input_hex[h], r, center(x)});
    }
  poor.count = mesh.comm.sum(static_cast<long long>(poor.worst.size()));
  sort_and_cut(poor.worst);
  std::vector<double> mine;
  for (const auto& [q, number, region, c] : poor.worst)
    mine.insert(mine.end(), {q, double(number), double(region), c[0], c[1], c[2]});
  const auto all = mesh.comm.gather(std::span<const double>(mine));
  poor.worst.clear();
  for (std::size_t i = 0; i < all.size(); i += 6)
    poor.worst.push_back({all[i], int(all[i + 1]), int(all[i + 2]), {all[i + 3], all[i + 4], all[i + 5]}});
  sort_and_cut(poor.worst);
  return poor;
}

void refuse_inverted(const Mesh& mesh) {
  PoorCells inverted;
  for (int h = 0; h < std::ssize(mesh.hexes); ++h) {
    const auto x = corners(mesh, h);
    if (const double q = comparable(scaled_jacobian(x)); q <= 0)
      inverted.worst.push_back({q, h, mesh.region[h], center(x)});
  }
  inverted.count = std::ssize(inverted.worst);
  sort_and_cut(inverted.worst);
  if (inverted.count > 0) refuse(inverted, mesh.region_names);
}

void refuse_inverted(const LocalMesh& mesh) {
  if (const PoorCells inverted = poor_cells(mesh, 0); inverted.count > 0) refuse(inverted, mesh.region_names);
}

}  // namespace bulbus::inline mesh
