#include "app/memory/mesh_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/mesh/geometry.hpp"
#include "core/mesh/quality.hpp"

namespace bulbus::inline app {
namespace {

constexpr double poor = .1;  // a quarter of the least value in the eye that is drawn

// Half the cross product of the diagonals: exact for plane faces.
double area_of(const LocalMesh& mesh, const Quad& q) {
  return .5 * norm(cross(at(mesh.X, q[2]) - at(mesh.X, q[0]), at(mesh.X, q[3]) - at(mesh.X, q[1])));
}

}  // namespace

std::vector<std::string> surface_lines(const LocalMesh& mesh) {
  if (mesh.surfaces.empty()) return {};
  std::vector<std::string> lines{fmt::format("{:<20} {:>10} {:>14}", "surface", "faces", "area mm2")};
  for (const auto& [name, quads] : mesh.surfaces) {
    double area = 0;
    for (const Quad& q : quads) area += area_of(mesh, q);
    lines.push_back(fmt::format("{:<20} {:>10} {:>14.6g}", name,
                                mesh.comm.sum(static_cast<long long>(quads.size())), mesh.comm.sum(area)));
  }
  return lines;
}

std::vector<std::string> set_lines(const LocalMesh& mesh) {
  std::vector<std::string> lines;
  for (const auto& [name, nodes] : mesh.sets) {
    const auto owned = std::ranges::count_if(nodes, [&](int n) { return n < mesh.owned; });
    lines.push_back(fmt::format("{:<20} {:>10}", name, mesh.comm.sum(static_cast<long long>(owned))));
  }
  if (!lines.empty()) lines.insert(lines.begin(), fmt::format("{:<20} {:>10}", "node set", "nodes"));
  return lines;
}

std::vector<std::string> poor_cell_lines(const LocalMesh& mesh) {
  const PoorCells cells = poor_cells(mesh, std::nextafter(poor, 0.));
  if (cells.count == 0) return {};
  std::vector<std::string> lines{
      fmt::format("{} hexahedra have a scaled Jacobian below {}, worst first:", cells.count, poor)};
  for (const PoorCell& c : cells.worst)
    lines.push_back(fmt::format("  {:.4f}  hexahedron {} of region '{}' about ({:.4g}, {:.4g}, {:.4g}) mm",
                                c.quality, c.number + 1, mesh.region_names[c.region], c.center[0],
                                c.center[1], c.center[2]));
  if (const auto others = cells.count - std::ssize(cells.worst); others > 0)
    lines.push_back(fmt::format("  and {} others", others));
  return lines;
}

}  // namespace bulbus::inline app
