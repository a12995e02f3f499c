#include "core/mesh/eye_parts.hpp"
#include "core/mesh/eye_sheet.hpp"
#include "core/mesh/o_grid.hpp"

namespace bulbus {

void add_lens(Mesh& mesh, const EyeSettings& s) {
  const EyeShape& e = s.shape;
  const Disc disc = o_grid(s.n / 2, scaled(1, s.n), .72, true);
  const int layers = 6 * scaled(1, s.n), first = static_cast<int>(mesh.points.size());
  const int per_level = static_cast<int>(disc.nodes.size());
  for (int k = 0; k <= layers; ++k)
    for (const Disc::Node& d : disc.nodes) {
      const double rho = d.radius * .5 * e.lens_diameter, u = static_cast<double>(k) / layers;
      mesh.points.push_back({rho * d.x, rho * d.y, (1 - u) * e.lens_bottom(rho) + u * e.lens_top(rho)});
    }
  for (const auto& q : disc.quads)
    for (int k = 0; k < layers; ++k) {
      Hex h;
      for (int c = 0; c < 4; ++c) {
        h[c] = first + k * per_level + q[c];
        h[c + 4] = h[c] + per_level;
      }
      mesh.hexes.push_back(h);
      mesh.region.push_back(lens);
    }
}

}  // namespace bulbus
