#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "core/base/error.hpp"
#include "core/base/parse_number.hpp"
#include "core/base/printable.hpp"
#include "core/mesh/faces.hpp"
#include "core/mesh/generate/embed.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/gmsh/gmsh_file.hpp"
#include "core/mesh/repeated.hpp"

namespace bulbus::inline mesh {
namespace {

/// Numbers the nodes that hexahedra use in the order of the file.
std::vector<int> used_nodes(const GmshFile& file, Mesh& mesh) {
  std::vector<int> id(file.points.size(), -1);
  for (const auto& e : file.elements)
    if (e.dimension == 3)
      for (int k : e.nodes) id[k] = 0;
  for (std::size_t k = 0; k < id.size(); ++k)
    if (id[k] == 0) {
      id[k] = static_cast<int>(mesh.points.size());
      mesh.points.push_back(file.points[k]);
    }
  return id;
}

int region_of(const GmshFile& file, Mesh& mesh, int group) {
  const std::string name = file.group_name(3, group);
  if (const int r = region_index(mesh, name); r >= 0) return r;
  mesh.region_names.push_back(name);
  return static_cast<int>(mesh.region_names.size()) - 1;
}

void add_hexes(const GmshFile& file, const std::vector<int>& id, Mesh& mesh) {
  std::map<int, int> regions;
  std::set<int> used;
  for (const auto& e : file.elements)
    if (e.dimension == 3) used.insert(e.group);
  for (const auto& [key, name] : file.names)
    if (key.first == 3 && used.contains(key.second)) regions[key.second] = region_of(file, mesh, key.second);
  for (const auto& e : file.elements) {
    if (e.dimension != 3) continue;
    Hex h;
    for (int c = 0; c < 8; ++c) h[c] = id[e.nodes[c]];
    mesh.hexes.push_back(h);
    if (!regions.count(e.group)) regions[e.group] = region_of(file, mesh, e.group);
    mesh.region.push_back(regions[e.group]);
    if (hex_volume(mesh, static_cast<int>(mesh.hexes.size()) - 1) < 0)
      mesh.hexes.back() = {h[4], h[5], h[6], h[7], h[0], h[1], h[2], h[3]};
  }
}

const GmshFile::Element& hexahedron(const GmshFile& file, int number) {
  for (const auto& e : file.elements)
    if (e.dimension == 3 && number-- == 0) return e;
  throw std::out_of_range("no such hexahedron");
}

void refuse_repeated(const GmshFile& file, const Mesh& mesh) {
  const auto pairs = repeated(mesh.hexes);
  if (pairs.empty()) return;
  const auto [i, j] = pairs.front();
  const auto& first = hexahedron(file, i);
  const auto& again = hexahedron(file, j);
  file.refuse(again,
              fmt::format("of region '{}' has the same eight nodes as element {}{} of region '{}': {} of {} "
                          "hexahedra stand twice",
                          file.group_name(3, again.group), first.number,
                          first.line > 0 ? fmt::format(" (line {})", first.line) : "",
                          file.group_name(3, first.group), pairs.size(), mesh.hexes.size()),
              "let every volume belong to one Physical Volume (MSH 2.2 lists it once for each), and save the "
              "mesh again");
}

void add_surfaces(const GmshFile& file, const std::vector<int>& id, Mesh& mesh) {
  const FaceTable table(mesh.hexes);
  std::map<std::string, std::set<int>> seen;
  for (const auto& e : file.elements) {
    if (e.dimension != 2) continue;
    const Quad q{id[e.nodes[0]], id[e.nodes[1]], id[e.nodes[2]], id[e.nodes[3]]};
    const int face = *std::min_element(q.begin(), q.end()) < 0 ? -1 : table.first(q);
    const std::string name = file.group_name(2, e.group);
    if (face < 0)
      file.refuse(e, "of surface '" + name + "' is no face of a hexahedron",
                  "mesh the surface as the boundary of its volume, and save both");
    if (seen[name].insert(face).second) mesh.surfaces[name].push_back(face_nodes(mesh.hexes, face));
  }
}

void add_node_sets(const GmshFile& file, const std::vector<int>& id, Mesh& mesh) {
  for (const auto& e : file.elements) {
    if (e.dimension != 0) continue;
    const std::string name = file.group_name(0, e.group);
    if (id[e.nodes[0]] < 0)
      file.refuse(e, "of the points '" + name + "' is no node of a hexahedron",
                  "embed the point in its volume");
    mesh.node_sets[name].push_back(id[e.nodes[0]]);
  }
}

/// Takes " share=NUMBER" off a group's name.
double take_share(const GmshFile& file, const GmshFile::Element& e, std::string& name) {
  const std::string key = " share=";
  const std::size_t at = name.rfind(key);
  if (at == std::string::npos) return 1;
  const auto share = parse_number<double>(std::string_view(name).substr(at + key.size()));
  if (!share || !(*share > 0 && *share <= 1))
    file.refuse(
        e,
        "is a bar of the group '" + printable(name, true) + "', whose share is no number above 0 and up to 1",
        "end the group's name in ' share=0.5': the part of the bar that the drawn model owns");
  name.resize(at);
  return *share;
}

EmbeddedPoint bar_end(const GmshFile& file, const GmshFile::Element& e, int node, const std::vector<int>& id,
                      const Mesh& mesh, const std::vector<Quad>& boundary) {
  if (id[node] >= 0) return at_node(id[node]);
  const Embedding found = embed(mesh, boundary, file.points[node]);
  if (found.distance > .1 * found.size)
    file.refuse(e, "is a bar with an end neither in a node nor on the surface of the hexahedra",
                "move the end onto the surface");
  return found.point;
}

void add_bars(const GmshFile& file, const std::vector<int>& id, Mesh& mesh) {
  std::vector<Quad> boundary;
  std::map<std::pair<std::string, std::pair<int, int>>, long long> seen;
  for (const auto& e : file.elements) {
    if (e.dimension != 1) continue;
    if (boundary.empty()) boundary = boundary_faces(mesh);
    std::string name = file.group_name(1, e.group);
    const double share = take_share(file, e, name);
    const auto [first, fresh] =
        seen.emplace(std::pair{name, std::pair<int, int>(std::minmax(e.nodes[0], e.nodes[1]))}, e.number);
    if (!fresh)
      file.refuse(
          e,
          fmt::format("joins the same two nodes as bar {} of '{}': it would pull twice", first->second, name),
          "list every bar once; a thicker one has a larger `area`");
    mesh.bars[name].push_back({bar_end(file, e, e.nodes[0], id, mesh, boundary),
                               bar_end(file, e, e.nodes[1], id, mesh, boundary), share});
  }
}

}  // namespace

Mesh mesh_of(const GmshFile& file) {
  file.refuse_others();
  Mesh mesh;
  const std::vector<int> id = used_nodes(file, mesh);
  add_hexes(file, id, mesh);
  if (mesh.hexes.empty())
    throw input_error(file.path, 0, "the mesh has no hexahedra",
                      "mesh the volumes in 3-D with 8-node hexahedra");
  refuse_repeated(file, mesh);
  add_surfaces(file, id, mesh);
  add_node_sets(file, id, mesh);
  add_bars(file, id, mesh);
  return mesh;
}

}  // namespace bulbus::inline mesh
