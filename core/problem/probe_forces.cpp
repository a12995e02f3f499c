// Probes of forces: supports, bars and liquids.
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/problem/closed_surface.hpp"
#include "core/problem/probe_figures.hpp"

namespace bulbus::probes {
namespace {

struct Resultant {
  Vec3<double> force{}, moment{};
  double radial = 0;
};

Resultant own_resultant(Snapshot& s, std::span<const int> nodes) {
  const auto& f = s.residual().force;
  const auto& x = s.state.x;
  Resultant sum;
  for (int n : nodes) {
    const Vec3<double> F{f[3 * n], f[3 * n + 1], f[3 * n + 2]},
        M = cross({x[3 * n], x[3 * n + 1], x[3 * n + 2]}, F);
    for (int c = 0; c < 3; ++c) sum.force[c] += F[c], sum.moment[c] += M[c];
    const double r = std::hypot(x[3 * n], x[3 * n + 1]);
    if (r > 0) sum.radial += (x[3 * n] * F[0] + x[3 * n + 1] * F[1]) / r;
  }
  return sum;
}

// The image in a plane has the opposite normal force; its moment, a cross product, keeps the normal component
// only.
void add_images(const Problem& problem, Resultant& r) {
  for (const std::string& plane : problem.model().symmetry)
    for (int c = 0; c < 3; ++c) {
      const bool normal = c == axis_of(plane);
      r.force[c] *= normal ? 0 : 2;
      r.moment[c] *= normal ? 2 : 0;
    }
  r.radial *= problem.multiplicity();
}

Resultant resultant(Snapshot& s, std::span<const int> nodes) {
  Resultant r = own_resultant(s, nodes);
  std::array<double, 7> all{r.force[0],  r.force[1],  r.force[2], r.moment[0],
                            r.moment[1], r.moment[2], r.radial};
  s.problem.comm().sum(all);
  r = {{all[0], all[1], all[2]}, {all[3], all[4], all[5]}, all[6]};
  add_images(s.problem, r);
  return r;
}

std::size_t liquid_of(const Problem& problem, const ProbeSpec& spec) {
  const auto& all = problem.liquids();
  return std::ranges::find(all, spec.liquid, &Liquid::name) - all.begin();
}

}  // namespace

ProbeSet::Figure reaction(const Problem& problem, const ProbeSpec& spec) {
  return [nodes = owned_nodes(problem, spec.set), c = spec.component](Snapshot& s) {
    const Resultant r = resultant(s, nodes);
    return c == "radial" ? r.radial : component_of(r.force, c);
  };
}

ProbeSet::Figure moment(const Problem& problem, const ProbeSpec& spec) {
  return [nodes = owned_nodes(problem, spec.set), c = spec.component](Snapshot& s) {
    return component_of(resultant(s, nodes).moment, c);
  };
}

ProbeSet::Figure bar_force(const Problem& problem, const ProbeSpec& spec) {
  if (problem.bars().empty()) throw scene_error("kind", "the model has no bars", "Take the probe out.");
  return [spec](Snapshot& s) {
    std::vector<double> forces;
    for (const auto& [name, term] : s.problem.bars())
      if (spec.region.empty() || spec.region == name)
        for (double f : term->bars().forces(s.state.x)) forces.push_back(f);
    return statistic(s.problem.comm(), spec.statistic, forces);
  };
}

ProbeSet::Figure pressure(const Problem& problem, const ProbeSpec& spec) {
  return [i = liquid_of(problem, spec)](Snapshot& s) { return s.state.P[i]; };
}

ProbeSet::Figure volume(const Problem& problem, const ProbeSpec& spec) {
  return [i = liquid_of(problem, spec)](Snapshot& s) {
    return s.problem.multiplicity() * s.problem.liquids()[i].volume(s.state.x);
  };
}

}  // namespace bulbus::probes
