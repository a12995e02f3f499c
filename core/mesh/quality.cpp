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

constexpr std::size_t most_listed = 50;  // cells in one message

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

void refuse(const std::array<Point, 8>& x, int input_hex, const std::string& region,
            const std::string& others = "") {
  Point c{};
  for (const Point& p : x) c = c + .125 * p;
  throw input_error(fmt::format("hexahedron {} of region '{}' about ({:.4g}, {:.4g}, {:.4g}) mm is inside "
                                "out or flat (scaled Jacobian {:.3g}){}",
                                input_hex + 1, region, c[0], c[1], c[2], scaled_jacobian(x), others),
                    "smooth or refine the mesh there");
}

// Scaled Jacobian and number of a cell, worst first.
using BadCells = std::vector<std::pair<double, int>>;

// Of a cell that is inside out or flat; what is not a number is worst.
bool note_if_bad(double quality, int number, BadCells& bad) {
  if (quality > 0) return false;
  bad.emplace_back(quality <= 0 ? quality : -2, number);
  return true;
}

// All but the first of sorted ones, of which there are `all`.
std::string others_of(const BadCells& bad, std::size_t all) {
  if (all < 2) return "";
  std::string others = fmt::format("; so are {} others, worst first:", all - 1);
  for (std::size_t i = 1; i < bad.size() && i <= most_listed; ++i)
    others += fmt::format("{} {} ({:.3g})", i > 1 ? "," : "", bad[i].second + 1, bad[i].first);
  return others + (all > most_listed + 1 ? ", ..." : "");
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

void refuse_inverted(const Mesh& mesh) {
  BadCells bad;
  for (std::size_t e = 0; e < mesh.hexes.size(); ++e)
    note_if_bad(scaled_jacobian(mesh, static_cast<int>(e)), static_cast<int>(e), bad);
  if (bad.empty()) return;
  std::ranges::sort(bad);
  const int worst = bad[0].second;
  refuse(corners(mesh, worst), worst, mesh.region_names[mesh.region[worst]], others_of(bad, bad.size()));
}

void refuse_inverted(const LocalMesh& mesh) {
  BadCells bad;
  std::map<int, int> local;
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    if (note_if_bad(scaled_jacobian(corners(mesh, static_cast<int>(h))), mesh.input_hex[h], bad))
      local[mesh.input_hex[h]] = static_cast<int>(h);
  const auto all = mesh.comm.sum(static_cast<long long>(bad.size()));
  if (all == 0) return;
  std::ranges::sort(bad);
  std::vector<double> worst;
  for (std::size_t i = 0; i < std::min(bad.size(), most_listed + 1); ++i)
    worst.insert(worst.end(), {bad[i].first, static_cast<double>(bad[i].second)});
  const auto gathered = mesh.comm.gather(std::span<const double>(worst));
  bad.clear();
  for (std::size_t i = 0; i < gathered.size(); i += 2)
    bad.emplace_back(gathered[i], static_cast<int>(gathered[i + 1]));
  std::ranges::sort(bad);
  mesh.comm.together([&] {
    const auto at = local.find(bad[0].second);
    if (at == local.end()) return;
    const auto region = std::ranges::find_if(
        mesh.regions, [&](const auto& r) { return at->second >= r.first && at->second < r.first + r.count; });
    refuse(corners(mesh, at->second), at->first, mesh.region_names[region - mesh.regions.begin()],
           others_of(bad, all));
  });
}

}  // namespace bulbus
