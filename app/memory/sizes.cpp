#include "app/memory/sizes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace bulbus::inline app {

Sizes sizes_of(const Problem& problem) {
  const LocalMesh& mesh = problem.mesh();
  Sizes s;
  s.hexahedra = mesh.all_hexes;
  s.nodes = mesh.all_nodes;
  long long bars = 0, cells = 0;
  for (const auto& [name, group] : mesh.bars) bars += static_cast<long long>(group.size());
  for (const SolidRegion& r : problem.solid().regions()) cells += r.count;
  s.bars = mesh.comm.sum(bars);
  s.element_pressure = mesh.comm.sum(cells);
  s.liquid_pressure = static_cast<long long>(problem.liquids().size());
  for (const RigidBody& b : problem.dofs().bodies()) s.rigid += std::ranges::count(b.free(), true);
  s.displacement = problem.dofs().free_unknowns() - s.rigid;
  return s;
}

long long stable_pivots(const Problem& problem) {
  return problem.mesh().all_hexes + static_cast<long long>(problem.liquids().size());
}

std::vector<std::string> lines_of(const Sizes& s) {
  return {fmt::format("{} hexahedra, {} nodes, {} bars", s.hexahedra, s.nodes, s.bars),
          fmt::format("{} unknowns: {} displacements (less what the steps prescribe), {} element pressures, "
                      "{} liquid pressures, {} of rigid bodies",
                      s.unknowns(), s.displacement, s.element_pressure, s.liquid_pressure, s.rigid)};
}

std::vector<std::string> lines_of(const std::vector<RegionQuality>& quality) {
  std::vector<std::string> lines{fmt::format("{:<20} {:>10} {:>14}   {}", "region", "hexahedra", "volume mm3",
                                             "scaled Jacobian: least, 5 %, mean")};
  for (const RegionQuality& q : quality)
    lines.push_back(fmt::format("{:<20} {:>10} {:>14.6g}   {:.3f}  {:.3f}  {:.3f}", q.region, q.count,
                                q.volume, q.least, q.five_percent, q.mean));
  return lines;
}

std::vector<std::string> liquid_lines(const Problem& problem) {
  std::vector<std::string> lines;
  for (const Liquid& l : problem.liquids())
    lines.push_back(fmt::format("liquid '{}': {:.6g} mm3 in the whole", l.name(),
                                problem.multiplicity() * l.volume(problem.mesh().X)));
  return lines;
}

}  // namespace bulbus::inline app
