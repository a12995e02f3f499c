#include <fmt/format.h>

#include <cmath>

#include "app/commands.hpp"
#include "app/prepare.hpp"
#include "app/sizes.hpp"
#include "core/io/log.hpp"
#include "precond/displacement.hpp"

namespace bulbus {
namespace {

constexpr double megabyte = 1e6;

struct Estimate {
  std::string part;
  double bytes;
};

std::vector<Estimate> estimate(const Problem& problem, const Sizes& s, const LinearSettings& l, bool checkpoints) {
  const double nodes = static_cast<double>(s.nodes), cells = static_cast<double>(s.element_pressure),
               unknowns = static_cast<double>(s.unknowns());
  const Comm& comm = problem.comm();
  std::vector<Estimate> parts{
      {"mesh and elements", comm.sum(static_cast<double>(problem.mesh().bytes() + problem.solid().bytes()))},
      {"vectors", 30 * 8 * unknowns}};
  if (checkpoints) parts.push_back({"checkpoints", 90 * nodes + 32 * cells});  // start of the step, keys, and a table on its way to the file
  if (l.method == "direct") {
    // measured on eyes of 7,000 hexahedra and more; the factors of a compact body grow with the power 4/3
    parts.push_back({"matrix and its copies", 11e3 * cells});
    parts.push_back({"factors", 160 * std::pow(unknowns, 4.0 / 3)});
    return parts;
  }
  if (l.op == "cache") parts.push_back({"operator cache", 224 * cells});
  if (l.op == "assembled") parts.push_back({"assembled operator", 27 * 9 * 8 * nodes});
  parts.push_back({"Krylov basis", 2.0 * l.restart * unknowns * 8});
  if (chosen_displacement(l, problem) == "multigrid") {
    // coarser levels are a seventh of the finest; the base is factorised
    const Problem* base = &problem;
    while (base->coarser()) base = base->coarser();
    parts.push_back({"smoother and transfer", 300 * nodes});
    parts.push_back({"coarser levels", (parts[0].bytes + 224 * cells) / 7});
    parts.push_back({"base factors", 140 * std::pow(3.0 * static_cast<double>(base->mesh().all_nodes), 4.0 / 3)});
    return parts;
  }
  const bool whole = l.displacement == "boomeramg" || l.displacement == "boomeramg_nodal";
  parts.push_back({"preconditioner", (whole                        ? 2 * 27 * 9
                                      : l.displacement == "jacobi" ? 9
                                                                   : 2 * 27 * 3) *
                                         12 * nodes});
  return parts;
}

void print(const Log& log, const std::vector<std::string>& lines) {
  for (const std::string& line : lines) log.info(line);
}

}  // namespace

int check(const Scene& scene, const Comm& comm) {
  const Prepared prepared = prepare(scene, comm);
  const Problem& problem = *prepared.problem;
  const Sizes sizes = sizes_of(problem);
  const Log log("", comm);
  print(log, lines_of(prepared.quality));
  print(log, lines_of(sizes));
  print(log, liquid_lines(problem));
  log.info(fmt::format("memory to expect with the {} solver, over all ranks (MB, a rough estimate):",
                       scene.solver.linear.method));
  double total = 0;
  for (const auto& [part, bytes] : estimate(problem, sizes, scene.solver.linear, scene.output.checkpoint > 0)) {
    log.info(fmt::format("  {:<20} {:>10.1f}", part, bytes / megabyte));
    total += bytes;
  }
  log.info(fmt::format("  {:<20} {:>10.1f}", "together", total / megabyte));
  return 0;
}

}  // namespace bulbus
