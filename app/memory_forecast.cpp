#include "app/memory_forecast.hpp"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/memory.hpp"
#include "core/solve/direct_memory.hpp"
#include "core/solve/fgmres.hpp"
#include "precond/displacement.hpp"

namespace bulbus {
namespace {

constexpr double megabyte = 1e6, number = sizeof(double), single = sizeof(float);
// Krylov vectors of a solve: only those that it needs are made
constexpr int usual_basis = 30, basis_with_hierarchy = 18, basis_of_easy_solves = 12;

// Does a run end before weak pressure patterns and tight solves matter?
bool easy(const NewtonSettings& newton) { return std::min(newton.force, newton.volume) >= 1e-4; }

// Local numbers of one level, summed over ranks.
struct Size {
  double nodes, hexes, liquids;
  double nodal() const { return 3 * nodes; }
  double unknowns() const { return nodal() + hexes; }
};

Size size_of(const Problem& problem) {
  std::array<double, 2> sums{static_cast<double>(problem.mesh().nodes()), static_cast<double>(problem.mesh().hexes.size())};
  problem.comm().sum(sums);
  return {sums[0], sums[1], static_cast<double>(problem.liquids().size())};
}

// The basis, and work vectors in double precision.
double krylov_bytes(const Size& s, const SolverSettings& solver, int refinements) {
  const int most = easy(solver.newton) ? basis_of_easy_solves : refinements > 0 ? basis_with_hierarchy : usual_basis;
  const double vector = solver.newton.eta_max < least_of_plain_method ? 2 * number : single;
  return (std::min(solver.linear.restart, most) * vector + 6 * number) * s.unknowns();
}

double resident(const Comm& comm) {
  malloc_trim(0);  // what the preparation gave back
  return comm.sum(static_cast<double>(resident_bytes()));
}

// Scaling, liquid columns and the room of a product; moduli and penalties; strain, or mean tangents and places in single precision.
double system_bytes(const Size& s, const LinearSettings& l) {
  const double cache = l.op == "cache" ? 7 * 8 * single * s.hexes : l.op == "assembled" ? 27 * 9 * number * s.nodes : 0;
  const double smoothed = chosen_precision(l) == Precision::full ? 0 : sizeof(SingleTangent) / 16. * s.hexes + sizeof(NodeSingle) * s.nodes;
  return number * (s.unknowns() + (2 + s.liquids) * s.nodal() + 2 * s.hexes) + smoothed + cache;
}

// Line factors; Chebyshev's and the cycle's vectors; interpolation from a coarser level.
double smoother_bytes(const Size& s, const LinearSettings& l) {
  const double vectors = chosen_precision(l) == Precision::full ? 5 * 3 * number : 4 * sizeof(NodeSingle);
  return (15 * single + 8 + vectors + 3 * number + 4 + 3.4 * 8) * s.nodes;
}

// Nodal room of K; vectors. Of a refined mesh the matrix of slow patterns: pairs of coarser hexahedra, measured on eyes, where lines run
// through five and more of them; on one refined twice K's own lines. What setting it up needs besides is less than a Krylov basis that is
// still short.
double pressure_bytes(const Size& s, int refinements) {
  const double K = sizeof(NodeSingle) * s.nodes;
  if (refinements == 0) return K + 6 * number * s.hexes + 2 * number * s.nodes;
  const double coarser = s.hexes / (refinements == 1 ? 8 : 64), pairs = 20 * coarser * std::max(1.0, std::cbrt(coarser / 7350));
  return refinements == 1 ? 72 * pairs : K + 15 * single * s.nodes + 54 * s.hexes + 408 * pairs;
}

// MUMPS on the displacement block of a base mesh, measured on eyes.
double base_bytes(const Size& s, const LinearSettings& l) { return (chosen_precision(l) == Precision::full ? 178 : 89) * std::pow(s.nodal(), 4.0 / 3); }

void add_coarser_levels(const Problem& finest, const LinearSettings& l, std::vector<MemoryPart>& parts) {
  double levels = 0;
  const Problem* p = finest.coarser();
  for (; p->coarser(); p = p->coarser()) {
    const Size s = size_of(*p);
    levels += system_bytes(s, l) + smoother_bytes(s, l) + 3 * number * s.unknowns();
  }
  parts.push_back({"coarser levels", levels});
  parts.push_back({"base factors", base_bytes(size_of(*p), l)});
}

// Aggregates' blocks of 6 x 6 with each of 27 neighbours and their factors, measured on eyes; hypre's hierarchies; the nodes' blocks.
double coarse_bytes(const std::string& name, const Size& s, const LinearSettings& l) {
  if (name == "aggregation") return 27 * 36 * (chosen_precision(l) == Precision::full ? 40 : 28) * s.nodes / l.aggregation.nodes;
  if (name == "jacobi") return 9 * 12 * s.nodes;
  return (name == "boomeramg" || name == "boomeramg_nodal" ? 2 * 27 * 9 : 2 * 27 * 3) * 12 * s.nodes;
}

void add_direct(const Size& s, std::vector<MemoryPart>& parts) {
  parts.push_back({"matrix and its copies", direct_matrix_bytes(s.hexes)});
  parts.push_back({"factors", direct_factor_bytes(s.unknowns())});
}

void add_iterative(const Problem& problem, const Size& s, const SolverSettings& solver, std::vector<MemoryPart>& parts) {
  const LinearSettings& l = solver.linear;
  const std::string name = chosen_displacement(l, problem);
  parts.push_back({"operator", system_bytes(s, l)});
  parts.push_back({"smoother", smoother_bytes(s, l) + (1 + s.liquids) * number * s.nodal()});
  parts.push_back({"Krylov basis", krylov_bytes(s, solver, problem.mesh().refinements)});
  if (!easy(solver.newton)) parts.push_back({"element pressures", pressure_bytes(s, problem.mesh().refinements)});
  if (name == "multigrid" && problem.coarser())
    add_coarser_levels(problem, l, parts);
  else
    parts.push_back({"coarse matrix", coarse_bytes(name, s, l)});
}

}  // namespace

std::vector<MemoryPart> forecast_memory(const Prepared& prepared, const Scene& scene) {
  const Problem& problem = *prepared.problem;
  const Size s = size_of(problem);
  std::vector<MemoryPart> parts{{"program, mesh and problem", resident(problem.comm())}};
  // their code and buffers become resident when they are first called
  parts.push_back({"libraries at work", 15 * megabyte * problem.comm().size()});
  // states at rest, on trial and of a probe's beginning, right-hand side and solution
  parts.push_back({"states and residuals", number * 5 * s.unknowns()});
  // fields on their way to a file, measured; elsewhere they are less than a Krylov basis, which is gone by then
  if (scene.output.vtk && easy(scene.solver.newton)) parts.push_back({"results", 20 * megabyte});
  // the state that a step begins with; on their way to the file, nodes and hexahedra with their keys
  parts.push_back({"checkpoints", scene.output.checkpoint > 0 ? 90 * s.nodes + 32 * s.hexes : 24 * s.nodes + 8 * s.hexes});
  if (scene.solver.linear.method == "direct")
    add_direct(s, parts);
  else
    add_iterative(problem, s, scene.solver, parts);
  return parts;
}

double sum_of(const std::vector<MemoryPart>& parts) {
  double sum = 0;
  for (const MemoryPart& p : parts) sum += p.bytes;
  return sum;
}

void refuse_what_cannot_fit(const std::vector<MemoryPart>& parts, const LinearSettings& l) {
  const double limit = l.memory_limit > 0 ? l.memory_limit * megabyte : static_cast<double>(machine_bytes());
  const double total = sum_of(parts);
  if (l.method == "direct" || total <= limit) return;
  std::string list;
  for (const MemoryPart& p : parts) list += fmt::format("{}{} {:.0f}", list.empty() ? "" : ", ", p.name, p.bytes / megabyte);
  throw scene_error("mesh",
                    fmt::format("the run would need {:.0f} MB of memory, more than the {:.0f} MB {} ({})", total / megabyte, limit / megabyte,
                                l.memory_limit > 0 ? "that solver.linear.memory_limit allows" : "that this machine has", list),
                    "Refine once less (an eighth of the memory), or spread the run over more machines and say in solver.linear.memory_limit what they have.");
}

}  // namespace bulbus
