#include "app/scene/mesh_sets.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/problem/formula.hpp"

namespace bulbus::inline app {
namespace {

void refuse_known(const Mesh& mesh, const std::string& name, const std::string& key) {
  const char* kind = mesh.node_sets.contains(name)   ? "a node set"
                     : mesh.surfaces.contains(name)  ? "a surface"
                     : region_index(mesh, name) >= 0 ? "a region"
                                                     : nullptr;
  if (kind)
    throw scene_error(key, fmt::format("the mesh has {} '{}' already", kind, name), "Choose another name.");
}

std::string extent_of(const Mesh& mesh) {
  std::string text;
  for (int c = 0; c < 3; ++c) {
    const auto [low, high] = std::ranges::minmax(mesh.points, {}, [c](const Point& p) { return p[c]; });
    text += fmt::format("{}{} from {:.4g} to {:.4g}", c > 0 ? ", " : "", "XYZ"[c], low[c], high[c]);
  }
  return text;
}

// Per node, whether the condition holds.
std::vector<bool> chosen(const Mesh& mesh, const std::string& condition, const std::string& key) {
  const Formula formula(condition, key);
  formula.require_timeless();
  std::vector<bool> holds(mesh.points.size());
  for (std::size_t n = 0; n < holds.size(); ++n) holds[n] = formula.holds(mesh.points[n]);
  return holds;
}

[[noreturn]] void refuse_empty(const Mesh& mesh, const std::string& condition, const std::string& key,
                               const std::string& of) {
  throw scene_error(key, fmt::format("'{}' holds {}", condition, of),
                    "The nodes have " + extent_of(mesh) +
                        " mm. Leave room for round-off: \"X < 0.001\" rather than \"X == 0\".");
}

}  // namespace

void add_sets(Mesh& mesh, const std::map<std::string, std::string>& conditions) {
  for (const auto& [name, condition] : conditions) {
    const std::string key = "mesh.sets." + name;
    refuse_known(mesh, name, key);
    const std::vector<bool> holds = chosen(mesh, condition, key);
    std::vector<int> nodes;
    for (std::size_t n = 0; n < holds.size(); ++n)
      if (holds[n]) nodes.push_back(static_cast<int>(n));
    if (nodes.empty()) refuse_empty(mesh, condition, key, fmt::format("at none of {} nodes", holds.size()));
    mesh.node_sets[name] = std::move(nodes);
  }
}

void add_surfaces(Mesh& mesh, const std::map<std::string, std::string>& conditions) {
  if (conditions.empty()) return;
  const std::vector<Quad> outer = boundary_faces(mesh);
  for (const auto& [name, condition] : conditions) {
    const std::string key = "mesh.surfaces." + name;
    refuse_known(mesh, name, key);
    const std::vector<bool> holds = chosen(mesh, condition, key);
    std::vector<Quad> faces;
    for (const Quad& q : outer)
      if (std::ranges::all_of(q, [&](int n) { return holds[n]; })) faces.push_back(q);
    if (faces.empty())
      refuse_empty(mesh, condition, key, fmt::format("at all nodes of none of {} outer faces", outer.size()));
    mesh.surfaces[name] = std::move(faces);
  }
}

}  // namespace bulbus::inline app
