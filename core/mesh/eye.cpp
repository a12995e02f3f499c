#include "core/mesh/eye.hpp"

#include <cmath>

#include "core/mesh/eye_parts.hpp"
#include "core/mesh/eye_sheet.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus {
namespace {

/// Columns of nodes under the sheet, by level: 0 is the outer surface, `wall` the inner surface of sclera and
/// cornea, `choroid` that of the choroid, `inner` that of the retina and the ciliary body, `back` the
/// outer surface of the retina where it is detached. Above 0 (negative): the nerve.
class Columns {
 public:
  Columns(Mesh& mesh, const EyeSettings& s)
      : mesh_(mesh),
        shape_(s.shape),
        sheet(eye_sheet(s)),
        detached(detached_sheet(sheet, s)),
        scale(scaled(1, s.n)),
        wall(3 * scale),
        choroid(4 * scale),
        inner(6 * scale),
        back(inner + 1),
        nerve(8 * scale) {
    ids_.assign(sheet.nodes.size() * (nerve + back + 1), -1);
  }

  /// The node of a column at a level; made when first asked for.
  int node(int column, int level) {
    int& id = ids_[static_cast<std::size_t>(column) * (nerve + back + 1) + nerve + level];
    if (id < 0) {
      id = static_cast<int>(mesh_.points.size());
      mesh_.points.push_back(level < 0 ? nerve_place(column, level) : place(column, depth(column, level)));
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

 private:
  Mesh& mesh_;
  const EyeShape& shape_;
  std::vector<int> ids_;

 public:
  const EyeSheet sheet;
  const DetachedSheet detached;
  const int scale, wall, choroid, inner, back, nerve;

 private:
  /// Where the retina is detached, its outer nodes are not the choroid's.
  int under(int column, int level) const {
    return level == choroid && detached.lift[column] > 0 ? back : level;
  }

  double depth(int column, int level) const {
    const double t = sheet.nodes[column].t;
    if (level == back) return depth(t, choroid) + detached.lift[column];
    return depth(t, level) + (level > choroid ? detached.lift[column] : 0);
  }

  double depth(double t, int level) const {
    const double w = shape_.wall(t);
    if (level <= wall) return w * level / wall;
    const double coat = shape_.choroid(t), film = shape_.retina(t);
    const double coats = level <= choroid ? coat * (level - wall) / (choroid - wall)
                                          : coat + film * (level - choroid) / (inner - choroid);
    if (t <= shape_.ora) return w + coats;
    // The ciliary body's layers go from those of choroid and retina at the ora to equal ones at its end.
    const double even = static_cast<double>(level - wall) / (inner - wall);
    const double s = (t - shape_.ora) / (shape_.ciliary_end - shape_.ora);
    return w + shape_.ciliary(t) * ((1 - s) * coats / (coat + film) + s * even);
  }

  Point place(int column, double depth) const {
    const EyeSheet::Node& c = sheet.nodes[column];
    if (column == sheet.posterior_pole || column == sheet.anterior_pole)
      return {0, 0, shape_.place(c.t, depth).z};
    const EyeShape::Place p = shape_.place(c.t, depth);
    return {p.rho * c.x, p.rho * c.y, p.z};
  }

  Point nerve_place(int column, int level) const {
    Point p = place(column, 0);
    const double end = -(shape_.sclera_radius + shape_.nerve_length), s = static_cast<double>(-level) / nerve;
    p[2] = level == -nerve ? end : (1 - s) * p[2] + s * end;
    return p;
  }
};

void fill_columns(Columns& columns, const EyeShape& shape) {
  const EyeSheet& sheet = columns.sheet;
  const double limbus = shape.limbus();
  // Made first, so that they are numbered in the order of the choroid's.
  for (int column : columns.detached.nodes) columns.node(column, columns.back);
  for (int q = 0; q < static_cast<int>(sheet.quads.size()); ++q) {
    const double t = sheet.middle(q);
    if (q < sheet.nerve_quads) columns.fill(q, -columns.nerve, 0, optic_nerve);
    columns.fill(q, 0, columns.wall, t < limbus ? sclera : cornea);
    if (t < shape.ora) {
      columns.fill(q, columns.wall, columns.choroid, choroid);
      if (!columns.detached.torn[q]) columns.fill(q, columns.choroid, columns.inner, retina);
    } else if (t < shape.ciliary_end) {
      columns.fill(q, columns.wall, columns.inner, ciliary_body);
    }
  }
}

void name_nodes(Mesh& mesh, Columns& columns, const EyeSettings& s) {
  const EyeSheet& sheet = columns.sheet;
  const double tolerance = 1e-9 * s.shape.sclera_radius;
  mesh.node_sets["apex"] = {columns.node(sheet.anterior_pole, 0)};
  mesh.node_sets["retina_pole"] = {columns.node(sheet.posterior_pole, columns.inner)};
  for (int column : sheet.nerve_ring) mesh.node_sets["nerve_ring"].push_back(columns.node(column, 0));
  for (int c = 0; c < sheet.nerve_nodes; ++c)
    mesh.node_sets["nerve_end"].push_back(columns.node(c, -columns.nerve));
  for (int c = 0; c < static_cast<int>(sheet.nodes.size()); ++c) {
    const int k = columns.node(c, 0);
    if (std::abs(mesh.points[k][2]) <= s.band_half_width + tolerance)
      mesh.node_sets["equator_band"].push_back(k);
    if (std::abs(mesh.points[k][2]) <= tolerance) mesh.node_sets["equator"].push_back(k);
  }
}

void name_detached_nodes(Mesh& mesh, Columns& columns) {
  for (int column : columns.detached.nodes) {
    mesh.node_sets["detached"].push_back(columns.node(column, columns.back));
    mesh.node_sets["detached_bed"].push_back(columns.node(column, columns.choroid));
  }
  for (int column : columns.detached.rim)
    mesh.node_sets["tear_rim"].push_back(columns.node(column, columns.back));
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
  Columns columns(mesh, s);
  fill_columns(columns, s.shape);
  name_nodes(mesh, columns, s);
  name_detached_nodes(mesh, columns);
  add_lens(mesh, s);
  name_eye_surfaces(mesh, s.shape, outer_nodes(mesh, columns));
  add_zonules(mesh, s);
  return mesh;
}

}  // namespace bulbus
