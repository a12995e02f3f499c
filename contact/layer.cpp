#include "contact/layer.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include "core/base/tensor.hpp"

namespace bulbus {
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

}  // namespace

Layer layer_under(const Mesh& mesh, std::span<const Quad> faces) {
  std::map<Quad, std::vector<int>> hexes;
  for (int h = 0; h < static_cast<int>(mesh.hexes.size()); ++h)
    for (const auto& f : hex_faces) {
      const Hex& hex = mesh.hexes[h];
      hexes[key_of({hex[f[0]], hex[f[1]], hex[f[2]], hex[f[3]]})].push_back(h);
    }
  Layer layer{std::numeric_limits<double>::infinity(), {}};
  for (const Quad& face : faces) {
    const auto found = hexes.find(key_of(face));
    if (found == hexes.end()) continue;
    int h = found->second.front();
    layer.regions.insert(mesh.region[h]);
    Quad end = face;
    while (true) {
      end = opposite(mesh.hexes[h], end);
      const auto& sides = hexes.at(key_of(end));
      const auto next = std::ranges::find_if(sides, [&](int k) { return k != h && mesh.region[k] == mesh.region[h]; });
      if (next == sides.end()) break;
      h = *next;
    }
    layer.thickness = std::min(layer.thickness, norm(minus(middle(mesh, end), middle(mesh, face))));
  }
  return layer;
}

}  // namespace bulbus
