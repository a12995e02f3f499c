// Probes over the hexahedra of regions.
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
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
