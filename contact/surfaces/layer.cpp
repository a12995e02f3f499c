#include "contact/surfaces/layer.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "core/base/tensor.hpp"
#include "core/mesh/distributed/mesh_part.hpp"

namespace bulbus::inline contact {
namespace {

Quad key_of(Quad q) {
  std::sort(q.begin(), q.end());
  return q;
}

Vec3<double> middle(const Mesh& mesh, const Quad& q) {
  Vec3<double> m{0, 0, 0};
  for (int n : q)
    for (int c = 0; c < 3; ++c) m[c] += mesh.points[n][c] / 4;
  return m;
}

// The face across the hexahedron: its nodes are the other four.
Quad opposite(const Hex& hex, const Quad& face) {
  Quad other;
  std::ranges::copy_if(hex, other.begin(), [&](int n) { return std::ranges::find(face, n) == face.end(); });
  return other;
}

using HexesOfFace = std::map<Quad, std::vector<int>>;

HexesOfFace hexes_of_faces(const Mesh& mesh) {
  HexesOfFace hexes;
  for (int h = 0; h < static_cast<int>(mesh.hexes.size()); ++h)
    for (const auto& f : hex_faces) {
      const Hex& hex = mesh.hexes[h];
      hexes[key_of({hex[f[0]], hex[f[1]], hex[f[2]], hex[f[3]]})].push_back(h);
    }
  return hexes;
}

// The column of tissue under a face: hexahedra of one region, each across from the one before, and the
// last one's far face.
struct HexColumn {
  std::vector<int> hexes;
  Quad end;
};

HexColumn way_under(const Mesh& mesh, const HexesOfFace& hexes, const Quad& face) {
  HexColumn way{{}, face};
  const auto found = hexes.find(key_of(face));
  if (found == hexes.end()) return way;
  int h = found->second.front();
  while (true) {
    way.hexes.push_back(h);
    way.end = opposite(mesh.hexes[h], way.end);
    const auto& sides = hexes.at(key_of(way.end));
    const auto next =
        std::ranges::find_if(sides, [&](int k) { return k != h && mesh.region[k] == mesh.region[h]; });
    if (next == sides.end()) return way;
    h = *next;
  }
}

double least_thickness(const Mesh& mesh, std::span<const Quad> faces) {
  const auto hexes = hexes_of_faces(mesh);
  double least = std::numeric_limits<double>::infinity();
  for (const Quad& face : faces)
    if (const HexColumn way = way_under(mesh, hexes, face); !way.hexes.empty())
      least = std::min(least, norm(minus(middle(mesh, way.end), middle(mesh, face))));
  return least;
}

// Of the refined parts of a way under a face.
double refined_thickness(const Mesh& base, const HexColumn& way, const Quad& face, int refinements) {
  std::vector<bool> hexes(base.hexes.size());
  for (int h : way.hexes) hexes[h] = true;
  Extract column = extract(base, hexes, std::vector<bool>(base.points.size()));
  Quad top;
  for (int i = 0; i < 4; ++i)
    top[i] = static_cast<int>(std::ranges::lower_bound(column.nodes, face[i]) - column.nodes.begin());
  column.mesh.node_sets.clear();
  column.mesh.bars.clear();
  column.mesh.surfaces = {{"top", {top}}};
  const Mesh fine = refined(std::move(column.mesh), refinements).finest();
  return least_thickness(fine, fine.surfaces.at("top"));
}

}  // namespace

Layer layer_under(const Mesh& base, std::span<const Quad> faces, int refinements, const Comm& comm) {
  const auto hexes = hexes_of_faces(base);
  Layer layer{std::numeric_limits<double>::infinity(), {}};
  if (refinements == 0) layer.thickness = least_thickness(base, faces);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const HexColumn way = way_under(base, hexes, faces[i]);
    if (way.hexes.empty()) continue;
    layer.regions.insert(base.region[way.hexes.front()]);
    if (refinements > 0 && static_cast<int>(i) % comm.size() == comm.rank())
      layer.thickness = std::min(layer.thickness, refined_thickness(base, way, faces[i], refinements));
  }
  layer.thickness = comm.min(layer.thickness);
  return layer;
}

}  // namespace bulbus::inline contact
