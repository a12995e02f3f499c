#include "core/mesh/mesh_count.hpp"

#include <cmath>

namespace bulbus::inline mesh {
namespace {

// Octants of which a part of a sphere is made.
double octants(const std::string& part) {
  return part == "octant" ? 1 : part == "quarter" ? 2 : part == "half" ? 4 : 8;
}

// Of the sphere's side of an octant, three patches of n x n faces; where octants meet, nodes are counted
// twice.
double sphere_faces(double n) { return 3 * n * n; }
double sphere_nodes(double n) { return 3 * n * n + 3 * n + 1; }

}  // namespace

MeshCount count(const DiscMap& map, bool half) {
  const double n = map.n, rings = map.rings;
  if (half) return {2 * n * n + 4 * n * rings, (n + 1) * (2 * n + 1) + (4 * n + 1) * rings};
  return {4 * n * n + 8 * n * rings, (2 * n + 1) * (2 * n + 1) + 8 * n * rings};
}

MeshCount layered(const MeshCount& section, double layers) {
  return {section.hexes * layers, section.nodes * (layers + 1)};
}

MeshCount count(const BlockShape& b) {
  const double x = b.nx, y = b.ny, z = b.nz;
  return {x * y * z, (x + 1) * (y + 1) * (z + 1)};
}

MeshCount count(const ShellShape& s) {
  return layered({octants(s.part) * sphere_faces(s.n), octants(s.part) * sphere_nodes(s.n)}, s.layers);
}

MeshCount count(const BallShape& b) {
  const double n = b.n, layers = b.layers, parts = octants(b.part);
  return {parts * (n * n * n + layers * sphere_faces(n)),
          parts * (std::pow(n + 1, 3) + layers * sphere_nodes(n))};
}

MeshCount count(const CylinderShape& c) { return layered(count({c.n, c.rings, c.core}, false), c.layers); }

MeshCount count(const Mesh& mesh) { return {double(mesh.hexes.size()), double(mesh.points.size())}; }

MeshCount refined(const MeshCount& base, int times) {
  const double parts = std::pow(8.0, times);
  return {parts * base.hexes, parts * base.nodes};
}

}  // namespace bulbus::inline mesh
