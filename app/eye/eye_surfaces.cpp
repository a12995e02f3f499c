#include <algorithm>

#include "app/eye/eye_parts.hpp"

namespace bulbus::inline eye {
namespace {

template <class Predicate>
bool all_nodes(const Quad& q, Predicate&& holds) {
  return std::all_of(q.begin(), q.end(), holds);
}

/// Whether a face is the one of the hexahedron's four nodes from `first` on: 0 the inner, 4 the outer face of
/// a cell of the wall.
bool among(const Quad& q, const Hex& hex, int first) {
  const auto begin = hex.begin() + first, end = begin + 4;
  return all_nodes(q, [&](int k) { return std::find(begin, end, k) != end; });
}

}  // namespace

void name_eye_surfaces(Mesh& mesh, const EyeShape& shape, const std::vector<bool>& outer) {
  const double end = -(shape.sclera_radius + shape.nerve_length);
  std::vector<int> owner;
  const std::vector<Quad> faces = boundary_faces(mesh, &owner);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Quad& q = faces[f];
    const Hex& hex = mesh.hexes[owner[f]];
    const int region = mesh.region[owner[f]];
    const auto add = [&](const char* name) { mesh.surfaces[name].push_back(q); };
    if (all_nodes(q, [&](int k) { return mesh.points[k][0] == 0; })) {
      add("symmetry");
    } else if (region == optic_nerve) {
      const bool last = all_nodes(q, [&](int k) { return mesh.points[k][2] == end; });
      add(last ? "nerve_end" : "nerve_side");
      if (!last) add("outside");
    } else if (all_nodes(q, [&](int k) { return outer[k]; })) {
      add("outside");
      add(region == cornea ? "outer_cornea" : "outer_sclera");
    } else {
      add("cavity");
      if (region == retina && among(q, hex, 0)) add("inner_retina");
      if (region == retina && among(q, hex, 4)) add("retina_back");
      if (region == choroid) add("retina_bed");
      if (region == lens) add("lens_surface");
    }
  }
}

}  // namespace bulbus::inline eye
