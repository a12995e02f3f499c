#include "core/problem/nodal_forces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/mesh/hex_edges.hpp"
#include "core/problem/closed_surface.hpp"

namespace bulbus::inline problem {
namespace {

// A new node belongs to the sets of all nodes that it lies between: first of all in the middle of an edge.
bool has_an_edge(const Mesh& mesh, const std::vector<int>& nodes) {
  std::vector<char> in(mesh.points.size());
  for (int n : nodes) in[n] = 1;
  return std::ranges::any_of(mesh.hexes, [&](const Hex& h) {
    return std::ranges::any_of(hex_edges, [&](const auto& e) { return in[h[e[0]]] && in[h[e[1]]]; });
  });
}

// `tolerance`: as nodes are held on planes.
bool on_a_plane(const Mesh& mesh, const Model& model, int node, double tolerance) {
  return std::ranges::any_of(model.symmetry, [&](const std::string& plane) {
    return std::abs(mesh.points[node][axis_of(plane)]) <= tolerance;
  });
}

}  // namespace

void require_forces_kept(const Mesh& mesh, const Model& model) {
  for (std::size_t k = 0; k < model.steps.size(); ++k)
    for (std::size_t i = 0; i < model.steps[k].loads.size(); ++i) {
      const LoadSpec& load = model.steps[k].loads[i];
      if (!load.force || !has_an_edge(mesh, nodes_of(mesh, load.set))) continue;
      throw scene_error(
          fmt::format("steps.{}.loads.{}.set", k, i),
          "set '" + load.set +
              "' has more nodes where the mesh is refined, and every one of them would carry the `force`: "
              "their sum would depend on `mesh.refine`",
          "Give the sum over an area as a `pressure` on a surface, with `dead: true` and a `direction`, or "
          "choose a set of nodes of which no two are on one edge.");
    }
}

std::vector<std::string> forces_on_planes(const Mesh& mesh, const Model& model) {
  std::vector<std::string> sentences;
  const double tolerance = mesh_tolerance(mesh);
  for (const StepSpec& step : model.steps)
    for (const LoadSpec& load : step.loads) {
      if (!load.force) continue;
      const auto nodes = nodes_of(mesh, load.set);
      const auto count =
          std::ranges::count_if(nodes, [&](int n) { return on_a_plane(mesh, model, n, tolerance); });
      if (count > 0)
        sentences.push_back(fmt::format(
            "step '{}': {} of {} nodes of set '{}' lie on a plane of symmetry, where the drawn "
            "part and its image both carry the `force`: the whole has twice of it there. Give "
            "these nodes a set of their own with half of the force, or a quarter where two planes "
            "meet",
            step.name, count, nodes.size(), load.set));
    }
  return sentences;
}

}  // namespace bulbus::inline problem
