#include "core/mesh/imported.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus::inline mesh {

std::string other_cells_text(const OtherCells& others, long long hexahedra) {
  long long count = 0;
  std::string kinds;
  for (const auto& [kind, n] : others) {
    count += n;
    kinds += fmt::format("{}{} {}", kinds.empty() ? "" : ", ", n, kind);
  }
  return fmt::format("{} of {} cells are no 8-node hexahedra: {}", count, count + hexahedra, kinds);
}

void refuse_other_cells(const std::string& path, int line, const OtherCells& others, long long hexahedra,
                        const std::string& remedy) {
  throw input_error(path, line, other_cells_text(others, hexahedra), remedy);
}

std::vector<int> drop_unused_points(Mesh& mesh) {
  std::vector<int> number(mesh.points.size(), -1);
  for (const Hex& h : mesh.hexes)
    for (int n : h) number[n] = 0;
  int kept = 0;
  for (std::size_t n = 0; n < number.size(); ++n)
    if (number[n] == 0) {
      mesh.points[kept] = mesh.points[n];
      number[n] = kept++;
    }
  mesh.points.resize(kept);
  for (Hex& h : mesh.hexes)
    for (int& n : h) n = number[n];
  return number;
}

std::vector<bool> turn_inverted(Mesh& mesh) {
  std::vector<bool> turned(mesh.hexes.size());
  for (std::size_t e = 0; e < turned.size(); ++e)
    if (hex_volume(mesh, static_cast<int>(e)) < 0) {
      const Hex h = mesh.hexes[e];
      mesh.hexes[e] = {h[4], h[5], h[6], h[7], h[0], h[1], h[2], h[3]};
      turned[e] = true;
    }
  return turned;
}

}  // namespace bulbus::inline mesh
