#include "app/memory/mesh_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/mesh/geometry.hpp"
#include "core/mesh/quality.hpp"

namespace bulbus {
namespace {

constexpr double poor = .1;  // a quarter of the least value in the eye that is drawn
constexpr std::size_t most_listed = 50;

// Half the cross product of the diagonals: exact for plane faces.
double area_of(const LocalMesh& mesh, const Quad& q) {
  return .5 * norm(cross(at(mesh.X, q[2]) - at(mesh.X, q[0]), at(mesh.X, q[3]) - at(mesh.X, q[1])));
}

struct PoorCell {
  double quality;
  int number, region;
  Point center;
};

// Of all ranks, six numbers a cell.
std::vector<PoorCell> poor_cells(const LocalMesh& mesh) {
  std::vector<double> mine;
  Mesh cell;
  cell.points.resize(8);
  cell.hexes = {{0, 1, 2, 3, 4, 5, 6, 7}};
  for (std::size_t r = 0; r < mesh.regions.size(); ++r)
    for (int h = mesh.regions[r].first; h < mesh.regions[r].first + mesh.regions[r].count; ++h) {
      for (int k = 0; k < 8; ++k) cell.points[k] = at(mesh.X, mesh.hexes[h][k]);
      const double q = scaled_jacobian(cell, 0);
      if (q >= poor) continue;
      const Point c = center(cell, 0);
      mine.insert(mine.end(), {q, mesh.input_hex[h] + 1.0, static_cast<double>(r), c[0], c[1], c[2]});
    }
  const std::vector<double> all = mesh.comm.gather(mine);
  std::vector<PoorCell> cells;
  for (std::size_t i = 0; i + 5 < all.size(); i += 6)
    cells.push_back({all[i],
                     static_cast<int>(all[i + 1]),
                     static_cast<int>(all[i + 2]),
                     {all[i + 3], all[i + 4], all[i + 5]}});
  std::ranges::sort(cells, {}, [](const PoorCell& c) { return std::pair(c.quality, c.number); });
  return cells;
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
  const std::vector<PoorCell> cells = poor_cells(mesh);
  if (cells.empty()) return {};
  std::vector<std::string> lines{
      fmt::format("{} hexahedra have a scaled Jacobian below {}, worst first:", cells.size(), poor)};
  for (std::size_t i = 0; i < cells.size() && i < most_listed; ++i) {
    const PoorCell& c = cells[i];
    lines.push_back(fmt::format("  {:.4f}  hexahedron {} of region '{}' about ({:.4g}, {:.4g}, {:.4g}) mm",
                                c.quality, c.number, mesh.region_names[c.region], c.center[0], c.center[1],
                                c.center[2]));
  }
  if (cells.size() > most_listed) lines.push_back(fmt::format("  and {} others", cells.size() - most_listed));
  return lines;
}

}  // namespace bulbus
