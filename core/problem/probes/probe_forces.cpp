// Probes of forces: supports, bars and liquids.
#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/problem/closed_surface.hpp"
#include "core/problem/probes/probe_figures.hpp"

namespace bulbus::inline problem::probes {
namespace {

Resultant resultant(Snapshot& s, std::span<const int> nodes, const std::string& of) {
  const auto& force = s.residual().force;  // collective: also on a rank without these nodes
  Resultant own;
  for (int n : nodes) own.add(at(s.state.x, n), at(force, n));
  return total(s.problem, own, of);
}

// A residual there is balanced by the rest of the body: nothing supports its nodes one by one, and what a
// plane of symmetry holds of them is a force of all of its nodes.
void refuse_inside_rigid(const Problem& problem, const std::vector<int>& owned, const std::string& set) {
  const LocalMesh& mesh = problem.mesh();
  for (std::size_t r = 0; r < mesh.regions.size(); ++r) {
    const std::string& name = mesh.region_names[r];
    if (!problem.model().regions.at(name).rigid) continue;
    std::vector<bool> rigid(mesh.nodes());
    for (int n : mesh.region_nodes[r]) rigid[n] = true;
    if (problem.comm().any(std::ranges::any_of(owned, [&](int n) { return rigid[n]; })))
      throw scene_error("set",
                        "nodes of '" + set + "' are of the rigid region '" + name +
                            "', whose nodes no support holds one by one",
                        "Name a set of deformable tissue alone (mesh.sets), or give '" + name +
                            "' a material a thousand times as stiff as its neighbours' in place of `rigid`.");
  }
}

std::vector<int> supported_nodes(const Problem& problem, const std::string& set) {
  std::vector<int> nodes = owned_nodes(problem, set);
  refuse_inside_rigid(problem, nodes, set);
  return nodes;
}

std::size_t liquid_of(const Problem& problem, const ProbeSpec& spec) {
  const auto& all = problem.liquids();
  return std::ranges::find(all, spec.liquid, &Liquid::name) - all.begin();
}

}  // namespace

void Resultant::add(const Vec3<double>& place, const Vec3<double>& f) {
  const Vec3<double> m = cross(place, f);
  for (int c = 0; c < 3; ++c) force[c] += f[c], moment[c] += m[c];
  const double r = std::hypot(place[0], place[1]);
  if (r > 0) radial += (place[0] * f[0] + place[1] * f[1]) / r;
}

double Resultant::component(const std::string& c) const {
  return c == "radial" ? radial : component_of(force, c);
}

// The image in a plane has the opposite normal force; its moment, a cross product, keeps the normal component
// only.
Resultant with_images(const Problem& problem, Resultant r) {
  for (const std::string& plane : problem.model().symmetry)
    for (int c = 0; c < 3; ++c) {
      const bool normal = c == axis_of(plane);
      r.force[c] *= normal ? 0 : 2;
      r.moment[c] *= normal ? 2 : 0;
    }
  r.radial *= problem.multiplicity();
  return r;
}

Resultant total(const Problem& problem, const Resultant& own, const std::string& of) {
  std::array<double, 7> all{own.force[0],  own.force[1],  own.force[2], own.moment[0],
                            own.moment[1], own.moment[2], own.radial};
  problem.comm().sum(all);
  const Resultant sum{{all[0], all[1], all[2]}, {all[3], all[4], all[5]}, all[6]};
  return of == "part" ? sum : with_images(problem, sum);
}

ProbeSet::Figure reaction(const Problem& problem, const ProbeSpec& spec) {
  return [nodes = supported_nodes(problem, spec.set), c = spec.component, of = spec.of](Snapshot& s) {
    return resultant(s, nodes, of).component(c);
  };
}

ProbeSet::Figure moment(const Problem& problem, const ProbeSpec& spec) {
  return [nodes = supported_nodes(problem, spec.set), c = spec.component, of = spec.of](Snapshot& s) {
    return component_of(resultant(s, nodes, of).moment, c);
  };
}

// In the whole a drawn bar counts as often as its share of a bar times the number of images.
ProbeSet::Figure bar_force(const Problem& problem, const ProbeSpec& spec) {
  if (problem.bars().empty()) throw scene_error("kind", "the model has no bars", "Take the probe out.");
  return [spec](Snapshot& s) {
    std::vector<double> forces;
    std::array<double, 2> sum{};  // share times force, share
    for (const auto& [name, term] : s.problem.bars()) {
      if (!spec.region.empty() && spec.region != name) continue;
      const std::vector<double> of_group = term->bars().forces(s.state.x);
      for (std::size_t i = 0; i < of_group.size(); ++i) {
        const double share = term->bars().bars()[i].share;
        forces.push_back(of_group[i]);
        sum[0] += share * of_group[i], sum[1] += share;
      }
    }
    if (spec.statistic != "mean") return statistic(s.problem.comm(), spec.statistic, forces);
    s.problem.comm().sum(sum);
    return sum[0] / sum[1];
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

}  // namespace bulbus::inline problem::probes
