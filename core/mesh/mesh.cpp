#include "core/mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/did_you_mean.hpp"
#include "core/base/error.hpp"
#include "core/base/sort_unique.hpp"
#include "core/mesh/faces.hpp"

namespace bulbus::inline mesh {
namespace {

std::vector<int> sorted_unique(std::vector<int> nodes) {
  sort_unique(nodes);
  return nodes;
}

struct NamedNodes {
  std::string kind;
  std::vector<int> nodes;  // sorted
};

// What goes by the name, the node set before the surface before the region.
std::vector<NamedNodes> all_of_name(const Mesh& mesh, const std::string& name) {
  std::vector<NamedNodes> found;
  if (const auto at = mesh.node_sets.find(name); at != mesh.node_sets.end())
    found.push_back({"node set", sorted_unique(at->second)});
  if (const auto at = mesh.surfaces.find(name); at != mesh.surfaces.end())
    found.push_back({"surface", nodes_of_faces(at->second)});
  if (const int region = region_index(mesh, name); region >= 0)
    found.push_back({"region", nodes_of_region(mesh, region)});
  return found;
}

// Gmsh and Abaqus name points, faces and volumes apart, a scene's `set` does not.
void refuse_ambiguous(const std::string& name, const std::vector<NamedNodes>& found) {
  for (const NamedNodes& other : found)
    if (other.nodes != found[0].nodes)
      throw input_error(fmt::format("'{}' is a {} of {} nodes and a {} of {} nodes, not the same ones", name,
                                    found[0].kind, found[0].nodes.size(), other.kind, other.nodes.size()),
                        "Rename one of the two in the mesh file.");
}

std::vector<std::string> all_names(const Mesh& mesh) {
  std::vector<std::string> names = mesh.region_names;
  for (const auto& [name, nodes] : mesh.node_sets) names.push_back(name);
  for (const auto& [name, quads] : mesh.surfaces) names.push_back(name);
  return names;
}

std::string known_names(std::vector<std::string> names) {
  sort_unique(names);
  std::string text;
  for (const std::string& n : names) text += (text.empty() ? "" : ", ") + n;
  return text;
}

}  // namespace

int add_node(Mesh& mesh, const Parameters& parameters) {
  mesh.parameters.push_back(parameters);
  mesh.points.push_back(mesh.place(parameters));
  return static_cast<int>(mesh.points.size()) - 1;
}

std::vector<Quad> boundary_faces(const Mesh& mesh, std::vector<int>* owner) {
  std::vector<Quad> faces;
  if (owner) owner->clear();
  for (int f : outer_faces(mesh.hexes)) {
    faces.push_back(face_nodes(mesh.hexes, f));
    if (owner) owner->push_back(f / 6);
  }
  return faces;
}

std::vector<int> nodes_of_region(const Mesh& mesh, int region) {
  std::vector<int> nodes;
  for (std::size_t e = 0; e < mesh.hexes.size(); ++e)
    if (mesh.region[e] == region) nodes.insert(nodes.end(), mesh.hexes[e].begin(), mesh.hexes[e].end());
  return sorted_unique(std::move(nodes));
}

int region_index(const Mesh& mesh, const std::string& name) {
  const auto at = std::find(mesh.region_names.begin(), mesh.region_names.end(), name);
  return at == mesh.region_names.end() ? -1 : static_cast<int>(at - mesh.region_names.begin());
}

std::vector<int> nodes_of(const Mesh& mesh, const std::string& name) {
  std::vector<NamedNodes> found = all_of_name(mesh, name);
  const bool known = !found.empty();
  std::erase_if(found, [](const NamedNodes& n) { return n.nodes.empty(); });
  refuse_ambiguous(name, found);
  if (known) return found.empty() ? std::vector<int>{} : std::move(found[0].nodes);
  const std::vector<std::string> names = all_names(mesh);
  throw input_error("the mesh has no node set, surface or region '" + name + "'",
                    did_you_mean(name, names, "it has: " + known_names(names)));
}

}  // namespace bulbus::inline mesh
