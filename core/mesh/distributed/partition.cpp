#include "core/mesh/distributed/partition.hpp"

#include <metis.h>

#include <stdexcept>

#include "core/base/error.hpp"

namespace bulbus::inline mesh {

std::vector<int> partition(const Mesh& mesh, int parts) {
  const std::size_t cells = mesh.hexes.size();
  if (parts < 1 || static_cast<std::size_t>(parts) > cells)
    throw input_error(
        "cannot split " + std::to_string(cells) + " cells into " + std::to_string(parts) + " parts",
        "start fewer ranks, or refine the mesh");
  if (parts == 1) return std::vector<int>(cells, 0);

  idx_t count = static_cast<idx_t>(cells), nodes = static_cast<idx_t>(mesh.points.size());
  idx_t common = 4, pieces = parts, cut = 0;  // 4 common nodes: a shared face
  std::vector<idx_t> start(cells + 1), index;
  index.reserve(8 * cells);
  for (std::size_t e = 0; e < cells; ++e) {
    index.insert(index.end(), mesh.hexes[e].begin(), mesh.hexes[e].end());
    start[e + 1] = static_cast<idx_t>(index.size());
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  options[METIS_OPTION_NUMBERING] = 0;
  std::vector<idx_t> rank(cells), node_rank(mesh.points.size());
  if (METIS_PartMeshDual(&count, &nodes, start.data(), index.data(), nullptr, nullptr, &common, &pieces,
                         nullptr, options, &cut, rank.data(), node_rank.data()) != METIS_OK)
    throw std::runtime_error("METIS could not partition the mesh");
  return {rank.begin(), rank.end()};
}

}  // namespace bulbus::inline mesh
