#include "core/mesh/overlapping.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/mesh/faces.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/sorted.hpp"

namespace bulbus::inline mesh {
namespace {

// The face of an earlier hexahedron that lies on the same side of these nodes; −1 if there is none.
int overlapped(const FaceTable& table, const Quad& q, int face) {
  const Quad key = sorted(q);
  if (std::ranges::adjacent_find(key) != key.end()) return -1;  // collapsed: it has no sides
  const int first = table.directed(q);
  return first < face ? first : -1;
}

std::string with_region(const Mesh& mesh, int face) {
  return fmt::format("hexahedron {} (region '{}')", face / 6 + 1, mesh.region_names[mesh.region[face / 6]]);
}

}  // namespace

void refuse_overlapping(const Mesh& mesh) {
  const FaceTable table(mesh.hexes);
  int first = -1, again = -1, count = 0;
  for (int f = 0; f < 6 * static_cast<int>(mesh.hexes.size()); ++f)
    if (const int other = overlapped(table, face_nodes(mesh.hexes, f), f); other >= 0 && ++count == 1)
      first = other, again = f;
  if (count == 0) return;
  Point middle{};
  for (int n : face_nodes(mesh.hexes, again)) middle = middle + .25 * mesh.points[n];
  throw input_error(
      fmt::format("{} overlaps {}: both lie on the same side of the face at ({:.4g}, {:.4g}, {:.4g}) "
                  "mm; there are {} such faces",
                  with_region(mesh, again), with_region(mesh, first), middle[0], middle[1], middle[2], count),
      "Mesh every part of the body once.");
}

}  // namespace bulbus::inline mesh
