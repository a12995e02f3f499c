#include "app/export/inp_mesh.hpp"

#include <ranges>

#include "core/base/error.hpp"
#include "core/mesh/faces.hpp"

namespace bulbus::inline app {
namespace {

template <class Map>
std::vector<std::string> keys_of(const Map& map) {
  const auto keys = std::views::keys(map);
  return {keys.begin(), keys.end()};
}

void write_set(ExportFile& out, const std::string& head, const std::string& name,
               const std::vector<int>& members) {
  if (members.empty()) return;
  out.text("{}={}, GENERATE\n", head, name);
  for (const auto& [first, last] : runs_of(members)) out.text("{}, {}, 1\n", first + 1, last + 1);
}

// S1 to S6 are the local faces 0 to 5.
void write_surface(ExportFile& out, const FaceTable& table, const std::string& name,
                   const std::vector<Quad>& quads) {
  out.text("*SURFACE, NAME={}, TYPE=ELEMENT\n", name);
  for (const Quad& q : quads) {
    const int face = table.directed(q);
    if (face < 0)
      throw scene_error("mesh", "surface '" + name + "' has a face that is none of a hexahedron",
                        "Draw surfaces on faces of hexahedra.");
    out.text("{}, S{}\n", face / 6 + 1, face % 6 + 1);
  }
}

}  // namespace

InpMeshNames::InpMeshNames(const Mesh& mesh, const std::map<std::string, std::vector<int>>& node_sets,
                           std::vector<std::string>& notes)
    : regions("region", mesh.region_names, notes),
      sets("node set", keys_of(node_sets), notes),
      surfaces("surface", keys_of(mesh.surfaces), notes) {}

void write_inp_mesh(ExportFile& out, const Mesh& mesh, const std::map<std::string, std::vector<int>>& sets,
                    const InpMeshNames& names, const std::string& element) {
  out.text("*NODE\n");
  for (std::size_t n = 0; n < mesh.points.size(); ++n) {
    const Point& p = mesh.points[n];
    out.text("{}, {}, {}, {}\n", n + 1, decimal(p[0]), decimal(p[1]), decimal(p[2]));
  }
  out.text("*ELEMENT, TYPE={}\n", element);
  std::vector<std::vector<int>> of_region(mesh.region_names.size());
  for (std::size_t e = 0; e < mesh.hexes.size(); ++e) {
    out.text("{}", e + 1);
    for (int n : mesh.hexes[e]) out.text(", {}", n + 1);
    out.text("\n");
    of_region[mesh.region[e]].push_back(static_cast<int>(e));
  }
  for (std::size_t r = 0; r < of_region.size(); ++r)
    write_set(out, "*ELSET, ELSET", names.regions.of(mesh.region_names[r]), of_region[r]);
  for (const auto& [name, nodes] : sets) write_set(out, "*NSET, NSET", names.sets.of(name), nodes);
  const FaceTable table(mesh.hexes);
  for (const auto& [name, quads] : mesh.surfaces)
    if (!quads.empty()) write_surface(out, table, names.surfaces.of(name), quads);
}

}  // namespace bulbus::inline app
