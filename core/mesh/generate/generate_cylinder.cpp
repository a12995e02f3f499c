#include "core/mesh/generate/generate.hpp"
#include "core/mesh/generate/o_grid.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus::inline mesh {

Mesh generate(const CylinderShape& c) {
  Mesh mesh;
  const DiscMap map{c.n, c.rings, c.core};
  const Disc disc = o_grid(map, false);
  mesh.place = [c, map](const Parameters& p) -> Point {
    const DiscMap::Place d = map(p[0], p[1], p[2]);
    return {c.radius * d.radius * d.x, c.radius * d.radius * d.y,
            p[3] == c.layers ? c.height : c.height * p[3] / c.layers};
  };
  const int per_level = static_cast<int>(disc.nodes.size());
  for (int k = 0; k <= c.layers; ++k)
    for (const Disc::Node& d : disc.nodes) {
      if (d.radius == 0) mesh.node_sets["axis"].push_back(static_cast<int>(mesh.points.size()));
      add_node(mesh, {double(d.i), double(d.j), double(d.ring), double(k)});
    }
  for (int k = 0; k < c.layers; ++k)
    for (const auto& q : disc.quads) {
      Hex h;
      for (int a = 0; a < 4; ++a) {
        h[a] = q[a] + k * per_level;
        h[a + 4] = q[a] + (k + 1) * per_level;
      }
      mesh.hexes.push_back(h);
    }
  mesh.region.assign(mesh.hexes.size(), 0);
  mesh.region_names = {c.region};

  mesh.surfaces["outside"] = boundary_faces(mesh);
  for (const Quad& q : mesh.surfaces["outside"]) {
    const std::array<Point, 4> x = corners(mesh, q);
    const bool level = x[0][2] == x[1][2] && x[1][2] == x[2][2];
    mesh.surfaces[!level ? "side" : x[0][2] == 0 ? "bottom" : "top"].push_back(q);
  }
  return mesh;
}

}  // namespace bulbus::inline mesh
