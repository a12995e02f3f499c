#include "app/records/point_supports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace bulbus::inline app {
namespace {

// Strain of the hexahedra around the node: its force over their shear modulus and the area of one of their
// faces. At the apex of the encircled eye it was 0.7 where refraction was wrong by 5 D.
constexpr double drawn_out = 0.1;

std::set<std::string> held_sets(const Model& model) {
  std::set<std::string> sets;
  for (const FixSpec& fix : model.fix) sets.insert(fix.set);
  for (const StepSpec& step : model.steps)
    for (const DisplaceSpec& displace : step.displace) sets.insert(displace.set);
  return sets;
}

// Greatest shear modulus around a node times the area of a face, N.
double strength_around(const Problem& problem, int node) {
  const LocalMesh& mesh = problem.mesh();
  const auto volumes = problem.solid().reference_volumes();
  double strength = 0;
  for (const SolidRegion& r : problem.solid().regions())
    for (int h = r.first; h < r.first + r.count; ++h)
      if (std::ranges::count(mesh.hexes[h], node) > 0)
        strength = std::max(strength, initial_shear_modulus(r.material) * std::pow(volumes[h], 2. / 3));
  return strength;
}

// The owned node of a set that has no other, or -1 on other ranks; none of larger sets. Collective.
std::optional<int> only_node(const Problem& problem, const std::string& set) {
  std::vector<int> owned = problem.nodes_of(set);
  std::erase_if(owned, [&](int n) { return n >= problem.mesh().owned; });
  if (problem.comm().sum(static_cast<int>(owned.size())) != 1) return {};
  return owned.empty() ? -1 : owned[0];
}

}  // namespace

std::vector<std::string> point_supports(const Problem& problem, const State& state) {
  std::map<std::string, int> single;
  for (const std::string& set : held_sets(problem.model()))
    if (const auto node = only_node(problem, set)) single[set] = *node;
  if (single.empty()) return {};
  const std::vector<double> force = problem.residual(state).force;
  std::vector<std::string> all;
  for (const auto& [set, node] : single) {
    const double reaction = problem.comm().max(node < 0 ? 0 : norm(at(force, node))),
                 strength = problem.comm().max(node < 0 ? 0 : strength_around(problem, node));
    if (!(strength > 0) || reaction < drawn_out * strength) continue;
    all.push_back(fmt::format(
        "the only node of '{}' is held against {:.3g} N, which strains the hexahedra around it by some "
        "{:.1f} "
        "and draws them out, the more the finer the mesh is: no figure near them converges. Hold nodes with "
        "an extent, such as a face or a rim, or leave the support out where nothing needs it",
        set, reaction, reaction / strength));
  }
  return all;
}

}  // namespace bulbus::inline app
