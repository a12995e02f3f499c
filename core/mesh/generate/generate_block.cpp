#include "core/base/error.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus::inline mesh {

Mesh generate(const BlockShape& b) {
  for (int i = 0; i < 3; ++i)
    if (!(b.lower[i] < b.upper[i]))
      throw input_error("block: `upper` is not above `lower` in " + std::string(1, char('x' + i)),
                        "give lower < upper in each direction");
  Mesh mesh;
  const auto node = [&](int i, int j, int k) { return i + (b.nx + 1) * (j + (b.ny + 1) * k); };
  const auto at = [](double lo, double hi, int i, int n) { return i == n ? hi : lo + (hi - lo) * i / n; };
  for (int k = 0; k <= b.nz; ++k)
    for (int j = 0; j <= b.ny; ++j)
      for (int i = 0; i <= b.nx; ++i)
        mesh.points.push_back({at(b.lower[0], b.upper[0], i, b.nx), at(b.lower[1], b.upper[1], j, b.ny),
                               at(b.lower[2], b.upper[2], k, b.nz)});
  for (int k = 0; k < b.nz; ++k)
    for (int j = 0; j < b.ny; ++j)
      for (int i = 0; i < b.nx; ++i)
        mesh.hexes.push_back({node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
                              node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
                              node(i, j + 1, k + 1)});
  mesh.region.assign(mesh.hexes.size(), 0);
  mesh.region_names = {b.region};

  const std::vector<Quad> boundary = boundary_faces(mesh);
  for (int i = 0; i < 3; ++i) {
    const std::string axis(1, char('x' + i));
    mesh.surfaces[axis + "min"] =
        faces_where(mesh, boundary, [&](const Point& p) { return p[i] == b.lower[i]; });
    mesh.surfaces[axis + "max"] =
        faces_where(mesh, boundary, [&](const Point& p) { return p[i] == b.upper[i]; });
  }
  mesh.surfaces["outside"] = boundary;
  return mesh;
}

}  // namespace bulbus::inline mesh
