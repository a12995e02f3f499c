#include "core/problem/closed_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"

namespace bulbus::inline problem {

int axis_of(const std::string& name) { return name[0] - 'x'; }

double mesh_tolerance(const Mesh& mesh) {
  double size = 0;
  for (const Point& p : mesh.points)
    for (double c : p) size = std::max(size, std::abs(c));
  return 1e-9 * size;
}

void require_closed(const Mesh& mesh, const std::vector<Quad>& faces, std::span<const std::string> symmetry,
                    const std::string& surface, const std::string& key) {
  std::vector<std::pair<int, int>> edges;
  for (const Quad& q : faces)
    for (int i = 0; i < 4; ++i) edges.push_back(std::minmax(q[i], q[(i + 1) % 4]));
  std::sort(edges.begin(), edges.end());
  const double tolerance = mesh_tolerance(mesh);
  const auto in_plane = [&](const std::pair<int, int>& e) {
    return std::ranges::any_of(symmetry, [&](const std::string& s) {
      const int c = axis_of(s);
      return std::abs(mesh.points[e.first][c]) <= tolerance &&
             std::abs(mesh.points[e.second][c]) <= tolerance;
    });
  };
  for (auto e = edges.begin(); e != edges.end();) {
    const auto next = std::find_if(e, edges.end(), [&](const auto& other) { return other != *e; });
    if ((next - e) % 2 != 0 && !in_plane(*e)) {
      const Point &a = mesh.points[e->first], &b = mesh.points[e->second];
      throw scene_error(
          key,
          fmt::format("surface '{}' does not enclose a volume: its edge from ({:.4g}, {:.4g}, {:.4g}) to "
                      "({:.4g}, {:.4g}, {:.4g}) mm is open",
                      surface, a[0], a[1], a[2], b[0], b[1], b[2]),
          "Close the surface, or name the plane that cuts it under `symmetry`.");
    }
    e = next;
  }
}

}  // namespace bulbus::inline problem
