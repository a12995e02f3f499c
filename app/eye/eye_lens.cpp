#include "app/eye/eye_parts.hpp"

namespace bulbus::inline eye {

void add_lens(Mesh& mesh, const EyeMap& map) {
  const Disc disc = o_grid(map.lens_disc, true);
  const int first = static_cast<int>(mesh.points.size()), per_level = static_cast<int>(disc.nodes.size());
  for (int k = 0; k <= map.lens_layers; ++k)
    for (const Disc::Node& d : disc.nodes)
      add_node(mesh, {double(d.i), double(d.j), double(d.ring), double(k), EyeMap::lens});
  for (const auto& q : disc.quads)
    for (int k = 0; k < map.lens_layers; ++k) {
      Hex h;
      for (int c = 0; c < 4; ++c) {
        h[c] = first + k * per_level + q[c];
        h[c + 4] = h[c] + per_level;
      }
      mesh.hexes.push_back(h);
      mesh.region.push_back(lens);
    }
}

}  // namespace bulbus::inline eye
