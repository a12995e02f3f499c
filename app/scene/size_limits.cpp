#include "app/scene/size_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/memory.hpp"
#include "core/solve/direct_memory.hpp"

namespace bulbus::inline app {
namespace {

constexpr double indices = std::numeric_limits<int>::max();
// Measured on blocks, shells and eyes: the program itself, what is resident of mesh and
// problem when all is prepared, and what the making of a mesh needs at its peak
// (benchmarks/notebook/memory.md).
constexpr double of_program = 38 * megabyte, of_base_hex = 100, of_hex = 210, of_whole_hex = 450;

// Hexahedra and nodes are numbered over all ranks; a rank keeps eight numbers of each of its hexahedra, and
// all of the base.
void refuse_what_has_no_number(const MeshCount& base, const MeshCount& finest, int refinements, int ranks) {
  const double most = std::min(indices / 8, ranks * indices / 8 / std::pow(8.0, refinements));
  if (8 * base.hexes <= indices && finest.hexes + finest.nodes <= indices &&
      8 * finest.hexes <= ranks * indices)
    return;
  const std::string before =
      refinements > 0 ? fmt::format(" before they are refined {} times", refinements) : "";
  throw scene_error(
      "mesh",
      fmt::format("the mesh would have {:.3g} hexahedra and {:.3g} nodes, more than can be numbered",
                  finest.hexes, finest.nodes),
      fmt::format("Take fewer cells{}: at most some {:.0f}{}.",
                  refinements > 0 ? ", or refine less often" : "", most, before));
}

RunSize run_size(const MeshCount& base, const Scene& scene, int ranks) {
  RunSize size{.liquids = static_cast<double>(scene.model.liquids.size()),
               .refinements = scene.mesh.refine,
               .ranks = ranks};
  for (int k = scene.mesh.refine; k >= 0; --k) {
    const MeshCount c = refined(base, k);
    size.levels.push_back({c.nodes, c.hexes});
    if (!scene.solver.linear.wants_hierarchy()) break;
  }
  return size;
}

}  // namespace

double memory_of(const LinearSettings& l) { return l.allowed_mb() * megabyte; }

std::string whose_memory(const LinearSettings& l) {
  return l.memory_limit ? "that solver.linear.memory_limit allows" : "that this machine has";
}

void refuse_too_large(const MeshCount& base, const Scene& scene, int ranks) {
  const MeshCount finest = refined(base, scene.mesh.refine);
  refuse_what_has_no_number(base, finest, scene.mesh.refine, ranks);
  std::vector<MemoryPart> parts{
      {"program, mesh and problem", ranks * (of_program + of_base_hex * base.hexes) + of_hex * finest.hexes}};
  if (scene.solver.linear.method == Method::direct)
    parts.push_back({"matrix and its copies", direct_matrix_bytes(finest.hexes, true)});
  else
    for (MemoryPart& part : parts_of_solution(run_size(base, scene, ranks), scene))
      parts.push_back(std::move(part));
  refuse_more_than_there_is(parts, scene.solver.linear);
}

void refuse_too_large_to_make(const MeshCount& base, const Scene& scene) {
  const MeshCount finest = refined(base, scene.mesh.refine);
  refuse_what_has_no_number(base, finest, scene.mesh.refine, 1);
  refuse_more_than_there_is({{"program", of_program}, {"mesh", of_whole_hex * finest.hexes}},
                            scene.solver.linear);
}

void refuse_more_than_there_is(const std::vector<MemoryPart>& parts, const LinearSettings& l) {
  const double limit = memory_of(l), total = sum_of(parts);
  if (total <= limit) return;
  std::string list;
  for (const MemoryPart& p : parts)
    list += fmt::format("{}{} {:.0f}", list.empty() ? "" : ", ", p.name, p.bytes / megabyte);
  throw scene_error("mesh",
                    fmt::format("it would need {:.0f} MB of memory, more than the {:.0f} MB {} ({})",
                                total / megabyte, limit / megabyte, whose_memory(l), list),
                    "Refine once less (an eighth of the memory), take fewer cells, or spread the run over "
                    "more machines and say in solver.linear.memory_limit what they have.");
}

}  // namespace bulbus::inline app
