// Probes over the hexahedra of regions.
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/element/q1.hpp"
#include "core/problem/probes/probe_figures.hpp"

namespace bulbus::inline problem::probes {
namespace {

// The deformable hexahedra of the region, or of all.
std::vector<int> cells_of(const Problem& problem, const ProbeSpec& spec) {
  std::vector<int> cells;
  for (const SolidRegion& r : problem.solid().regions())
    if (spec.region.empty() || spec.region == r.name)
      for (int h = r.first; h < r.first + r.count; ++h) cells.push_back(h);
  if (!problem.comm().any(!cells.empty()))
    throw scene_error(
        "region",
        "'" + (spec.region.empty() ? std::string("all") : spec.region) + "' is rigid: nothing to record",
        "Name a region with a material, or take the probe out.");
  return cells;
}

void keep_those_at(const Problem& problem, std::span<const int> nodes, std::vector<int>& cells) {
  std::vector<bool> named(problem.mesh().nodes());
  for (int n : nodes) named[n] = true;
  std::erase_if(cells, [&](int h) {
    return std::ranges::none_of(problem.mesh().hexes[h], [&](int n) { return named[n]; });
  });
}

struct Weighted {
  double value, weight;
};

// Halving of the interval of values: a handful of sums over the ranks instead of all cells on one.
double percentile(const Comm& comm, std::span<const Weighted> cells, double percent) {
  const auto weight_up_to = [&](double limit) {
    double sum = 0;
    for (const Weighted& c : cells) sum += c.value <= limit ? c.weight : 0;
    return comm.sum(sum);
  };
  double least = INFINITY, most = -INFINITY;
  for (const Weighted& c : cells) least = std::min(least, c.value), most = std::max(most, c.value);
  least = comm.min(least), most = comm.max(most);
  const double wanted = percent / 100 * (1 - 1e-12) * weight_up_to(most);
  if (percent >= 100 || !(least < most)) return most;
  if (weight_up_to(least) >= wanted) return least;
  double low = least, high = most;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (weight_up_to(middle) >= wanted ? high : low) = middle;
  }
  double found = least;
  for (const Weighted& c : cells)
    if (c.value <= high) found = std::max(found, c.value);
  return comm.max(found);
}

// Share of a hexahedron that is at most `within` from one of the positions, by 8³ points.
double part_within(const LocalMesh& mesh, const Hex& hex, std::span<const Point> places, double within) {
  constexpr int m = 8;
  std::array<Vec3<double>, 8> X;
  for (int k = 0; k < 8; ++k) X[k] = at(mesh.drawn_places(), hex[vtk_of_lexicographic[k]]);
  Vec3<double> middle{0, 0, 0};
  double size = 0;
  for (const Vec3<double>& x : X)
    for (int c = 0; c < 3; ++c) middle[c] += x[c] / 8;
  for (const Vec3<double>& x : X) size = std::max(size, norm(minus(x, middle)));
  if (std::ranges::none_of(places, [&](const Point& p) { return norm(minus(middle, p)) <= within + size; }))
    return 0;
  int inside = 0;
  for (int i = 0; i < m * m * m; ++i) {
    const std::array<double, 3> xi{(i % m + .5) / m, (i / m % m + .5) / m, (i / (m * m) + .5) / m};
    Vec3<double> x{0, 0, 0};
    for (int k = 0; k < 8; ++k) {
      double N = 1;
      for (int c = 0; c < 3; ++c) N *= k >> c & 1 ? xi[c] : 1 - xi[c];
      for (int c = 0; c < 3; ++c) x[c] += N * X[k][c];
    }
    inside += std::ranges::any_of(places, [&](const Point& p) { return norm(minus(x, p)) <= within; });
  }
  return static_cast<double>(inside) / (m * m * m);
}

ProbeSet::Figure mises_of(std::vector<int> cells, double percent) {
  return [cells = std::move(cells), percent](Snapshot& s) {
    const auto V0 = s.problem.solid().reference_volumes();
    std::vector<Weighted> values;
    for (int h : cells) values.push_back({s.stresses()[h].mises, V0[h]});
    return percentile(s.problem.comm(), values, percent);
  };
}

}  // namespace

ProbeSet::Figure mises(const Problem& problem, const ProbeSpec& spec) {
  if (!spec.set.empty()) return mises_around(problem, spec, problem.nodes_of(spec.set));
  return mises_of(cells_of(problem, spec), spec.percentile);
}

ProbeSet::Figure mises_around(const Problem& problem, const ProbeSpec& spec, std::span<const int> nodes) {
  auto cells = cells_of(problem, spec);
  keep_those_at(problem, nodes, cells);
  if (!problem.comm().any(!cells.empty()))
    throw scene_error("set", "no deformable cell of the region touches these nodes",
                      "Name a region that does, or leave it out.");
  return mises_of(std::move(cells), spec.percentile);
}

ProbeSet::Figure mean_mises_near(const Problem& problem, const ProbeSpec& spec,
                                 std::span<const Point> places) {
  std::vector<Weighted> parts;  // number of the cell, its volume within
  for (int h : cells_of(problem, spec)) {
    const double part = part_within(problem.mesh(), problem.mesh().hexes[h], places, spec.within);
    if (part > 0) parts.push_back({1. * h, part * problem.solid().reference_volumes()[h]});
  }
  if (!problem.comm().any(!parts.empty()))
    throw scene_error("within", "no deformable cell of the region is so near",
                      "Give a larger distance, or name another region.");
  return [parts = std::move(parts)](Snapshot& s) {
    std::array<double, 2> sum{0, 0};
    for (const Weighted& c : parts)
      sum[0] += c.weight * s.stresses()[static_cast<std::size_t>(c.value)].mises, sum[1] += c.weight;
    s.problem.comm().sum(sum);
    return sum[0] / sum[1];
  };
}

ProbeSet::Figure volume_ratio(const Problem& problem, const ProbeSpec& spec) {
  return [cells = cells_of(problem, spec), kind = spec.statistic](Snapshot& s) {
    const auto V0 = s.problem.solid().reference_volumes();
    const auto& volume = s.residual().volume;  // collective: also on a rank without these cells
    std::vector<double> ratios;
    for (int h : cells) ratios.push_back(1 + volume[h] / V0[h]);
    return statistic(s.problem.comm(), kind, ratios);
  };
}

}  // namespace bulbus::inline problem::probes
