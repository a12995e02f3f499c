// Probes of positions and displacements.
#include <cmath>
#include <limits>
#include <numeric>

#include "core/problem/probes/probe_figures.hpp"

namespace bulbus::inline problem::probes {
namespace {

template <class Number>
ProbeSet::Figure over_nodes(const Problem& problem, const ProbeSpec& spec, Number number) {
  return [nodes = owned_nodes(problem, spec.set), kind = spec.statistic, number](Snapshot& s) {
    std::vector<double> numbers;
    for (int n : nodes) numbers.push_back(number(at(s.origin, n), at(s.state.x, n)));
    return statistic(s.problem.comm(), kind, numbers);
  };
}

Vec3<double> mean_place(const Snapshot& s, std::span<const int> nodes) {
  std::array<double, 4> sum{0, 0, 0, static_cast<double>(nodes.size())};
  for (int n : nodes)
    for (int c = 0; c < 3; ++c) sum[c] += s.state.x[3 * n + c];
  s.problem.comm().sum(sum);
  return {sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]};
}

// Distance from the z axis.
double mean_radius(const Snapshot& s, std::span<const int> nodes) {
  std::vector<double> radii;
  for (int n : nodes) radii.push_back(component_of(at(s.state.x, n), "radial"));
  return statistic(s.problem.comm(), "mean", radii);
}

}  // namespace

std::vector<int> owned_nodes(const Problem& problem, const std::string& set) {
  auto nodes = problem.nodes_of(set);
  std::erase_if(nodes, [&](int n) { return n >= problem.mesh().owned; });
  return nodes;
}

double component_of(const Vec3<double>& v, const std::string& component) {
  if (component == "magnitude") return norm(v);
  if (component == "radial") return std::hypot(v[0], v[1]);
  return v[component[0] - 'x'];
}

double statistic(const Comm& comm, const std::string& kind, std::span<const double> numbers) {
  constexpr double none = std::numeric_limits<double>::infinity();
  if (kind == "max")
    return comm.max(std::accumulate(numbers.begin(), numbers.end(), -none,
                                    [](double a, double b) { return std::max(a, b); }));
  if (kind == "min")
    return comm.min(std::accumulate(numbers.begin(), numbers.end(), none,
                                    [](double a, double b) { return std::min(a, b); }));
  std::array<double, 2> sum{std::accumulate(numbers.begin(), numbers.end(), 0.0),
                            static_cast<double>(numbers.size())};
  comm.sum(sum);
  return sum[0] / sum[1];
}

ProbeSet::Figure displacement(const Problem& problem, const ProbeSpec& spec) {
  return over_nodes(problem, spec, [c = spec.component](const Vec3<double>& X, const Vec3<double>& x) {
    if (c == "radial") return component_of(x, c) - component_of(X, c);
    return component_of(minus(x, X), c);
  });
}

ProbeSet::Figure position(const Problem& problem, const ProbeSpec& spec) {
  return over_nodes(problem, spec, [c = spec.component](const Vec3<double>&, const Vec3<double>& x) {
    return component_of(x, c);
  });
}

ProbeSet::Figure buckle_height(const Problem& problem, const ProbeSpec& spec) {
  return [crest = owned_nodes(problem, spec.set), beside = owned_nodes(problem, spec.to)](Snapshot& s) {
    return mean_radius(s, beside) - mean_radius(s, crest);
  };
}

ProbeSet::Figure distance(const Problem& problem, const ProbeSpec& spec) {
  return [from = owned_nodes(problem, spec.set), to = owned_nodes(problem, spec.to), c = spec.component](
             Snapshot& s) { return component_of(minus(mean_place(s, to), mean_place(s, from)), c); };
}

}  // namespace bulbus::inline problem::probes
