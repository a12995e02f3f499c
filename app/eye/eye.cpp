#include "app/eye/eye.hpp"

#include <algorithm>
#include <cmath>

#include "app/eye/eye_map.hpp"
#include "app/eye/eye_parts.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus::inline eye {
namespace {

/// Columns of nodes under the sheet, by the levels of the EyeMap; `back` is the outer surface of the retina
/// where it is detached.
class Columns {
 public:
  Columns(Mesh& mesh, const EyeSettings& s, const EyeMap& map)
      : map(map), sheet(eye_sheet(s)), detached(detached_sheet(sheet, s)), back(map.inner + 1), mesh_(mesh) {
    ids_.assign(sheet.nodes.size() * (map.nerve + back + 1), -1);
  }

  /// The node of a column at a level; made when first asked for.
  int node(int column, int level) {
    int& id = ids_[static_cast<std::size_t>(column) * (map.nerve + back + 1) + map.nerve + level];
    if (id < 0) {
      const EyeSheet::Node& c = sheet.nodes[column];
      const bool lifted = level > map.choroid && detached.lift[column] > 0;
      id =
          add_node(mesh_, {double(c.i), double(c.j), double(c.s), double(level == back ? map.choroid : level),
                           lifted ? EyeMap::lifted : EyeMap::attached});
    }
    return id;
  }

  /// Cells under a quad of the sheet between two levels.
  void fill(int quad, int from, int to, EyeRegion region) {
    for (int level = from; level < to; ++level) {
      Hex h;
      for (int c = 0; c < 4; ++c) {
        const int column = sheet.quads[quad][c];
        h[c] = node(column, level + 1);
        h[c + 4] = node(column, region == retina ? under(column, level) : level);
      }
      mesh_.hexes.push_back(h);
      mesh_.region.push_back(region);
    }
  }

  const EyeMap& map;
  const EyeSheet sheet;
  const DetachedSheet detached;
  const int back;

 private:
  /// Where the retina is detached, its outer nodes are not the choroid's.
  int under(int column, int level) const {
    return level == map.choroid && detached.lift[column] > 0 ? back : level;
  }

  Mesh& mesh_;
  std::vector<int> ids_;
};

void fill_columns(Columns& columns, const EyeShape& shape) {
  const EyeSheet& sheet = columns.sheet;
  const double limbus = shape.limbus();
  // Made first, so that they are numbered in the order of the choroid's.
  for (int column : columns.detached.nodes) columns.node(column, columns.back);
  for (int q = 0; q < static_cast<int>(sheet.quads.size()); ++q) {
    const double t = sheet.middle(q);
    if (q < sheet.nerve_quads) columns.fill(q, -columns.map.nerve, 0, optic_nerve);
    columns.fill(q, 0, columns.map.wall, t < limbus ? sclera : cornea);
    if (t < shape.ora) {
      columns.fill(q, columns.map.wall, columns.map.choroid, choroid);
      if (!columns.detached.torn[q]) columns.fill(q, columns.map.choroid, columns.map.inner, retina);
    } else if (t < shape.ciliary_end) {
      columns.fill(q, columns.map.wall, columns.map.inner, ciliary_body);
    }
  }
}

void name_nodes(Mesh& mesh, Columns& columns, const EyeSettings& s) {
  const EyeSheet& sheet = columns.sheet;
  const double tolerance = 1e-9 * s.shape.sclera_radius;
  mesh.node_sets["apex"] = {columns.node(sheet.anterior_pole, 0)};
  mesh.node_sets["retina_pole"] = {columns.node(sheet.posterior_pole, columns.map.inner)};
  for (int column : sheet.nerve_ring) mesh.node_sets["nerve_ring"].push_back(columns.node(column, 0));
  for (int c = 0; c < sheet.nerve_nodes; ++c)
    mesh.node_sets["nerve_end"].push_back(columns.node(c, -columns.map.nerve));
  for (int c = 0; c < static_cast<int>(sheet.nodes.size()); ++c) {
    const int k = columns.node(c, 0);
    if (columns.map.in_band(sheet.nodes[c].s)) mesh.node_sets["equator_band"].push_back(k);
    if (std::abs(mesh.points[k][2]) <= tolerance) mesh.node_sets["equator"].push_back(k);
  }
}

void name_detached_nodes(Mesh& mesh, Columns& columns) {
  for (int column : columns.detached.nodes) {
    mesh.node_sets["detached"].push_back(columns.node(column, columns.back));
    mesh.node_sets["detached_bed"].push_back(columns.node(column, columns.map.choroid));
  }
  for (int column : columns.detached.rim)
    mesh.node_sets["tear_rim"].push_back(columns.node(column, columns.back));
  if (columns.detached.rim.empty()) return;
  const auto ring = [&](int column) { return columns.sheet.nodes[column].s; };
  const auto [back, front] = std::ranges::minmax(columns.detached.rim, {}, ring);
  for (int column : columns.detached.rim)
    for (const auto& [name, edge] : {std::pair{"tear_bed_front", front}, {"tear_bed_back", back}})
      if (ring(column) == ring(edge))
        mesh.node_sets[name].push_back(columns.node(column, columns.map.choroid));
}

std::vector<bool> outer_nodes(const Mesh& mesh, Columns& columns) {
  std::vector<bool> outer(mesh.points.size(), false);
  for (int c = 0; c < static_cast<int>(columns.sheet.nodes.size()); ++c) outer[columns.node(c, 0)] = true;
  return outer;
}

}  // namespace

Mesh generate(const EyeSettings& s) {
  s.shape.check();
  Mesh mesh;
  mesh.region_names = {"cornea", "sclera", "ciliary_body", "choroid", "retina", "optic_nerve", "lens"};
  const EyeMap map(s);
  mesh.place = map;
  Columns columns(mesh, s, map);
  fill_columns(columns, s.shape);
  name_nodes(mesh, columns, s);
  name_detached_nodes(mesh, columns);
  add_lens(mesh, map);
  name_eye_surfaces(mesh, s.shape, outer_nodes(mesh, columns));
  add_zonules(mesh, s);
  return mesh;
}

}  // namespace bulbus::inline eye
