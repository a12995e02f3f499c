#include "app/memory/memory_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/memory.hpp"
#include "core/element/mean_tangent.hpp"
#include "core/solve/direct_memory.hpp"
#include "core/solve/fgmres.hpp"

namespace bulbus::inline app {
namespace {

// Numbers of bytes that are not a count of what is stored are fitted to runs: benchmarks/notebook/memory.md.
constexpr double number = sizeof(double), single = sizeof(float);
// Krylov vectors of a solve: only those that it needs are made
constexpr int usual_basis = 20, basis_with_hierarchy = 18, basis_of_easy_solves = 8;

// Does a run end before checkerboard modes of pressure and tight solves matter?
bool ends_early(const NewtonSettings& newton) { return std::min(newton.force, newton.volume) >= 1e-4; }

using Size = RunSize::Level;

// The basis, and work vectors in double precision.
double krylov_bytes(const Size& s, const SolverSettings& solver, int refinements) {
  const int most = ends_early(solver.newton) ? basis_of_easy_solves
                   : refinements > 0         ? basis_with_hierarchy
                                             : usual_basis;
  const double vector = solver.newton.eta_max < least_of_plain_method ? 2 * number : single;
  return (std::min(solver.linear.restart, most) * vector + 6 * number) * s.unknowns();
}

// Scaling, liquid columns and the workspace of a product; moduli and penalties; strain, or mean tangents and
// places in single precision.
double system_bytes(const Size& s, double liquids, const LinearSettings& l) {
  const double cache = l.op == TangentStorage::cache       ? 7 * 8 * single * s.hexes
                       : l.op == TangentStorage::assembled ? 27 * 9 * number * s.nodes
                                                           : 0;
  const double smoothed = l.smoothing == Precision::full
                              ? 0
                              : sizeof(SingleTangent) / 16. * s.hexes + sizeof(NodeSingle) * s.nodes;
  return number * (s.unknowns() + (2 + liquids) * s.nodal() + 2 * s.hexes) + smoothed + cache;
}

// Line factors; Chebyshev's and the cycle's vectors; interpolation from a coarser level.
double smoother_bytes(const Size& s, const LinearSettings& l) {
  const double vectors = l.smoothing == Precision::full ? 5 * 3 * number : 4 * sizeof(NodeSingle);
  return (15 * single + 8 + vectors + 3 * number + 4 + 3.4 * 8) * s.nodes;
}

// Pairs of coarser hexahedra that the matrix of checkerboard modes couples: those on one line. Lines run
// through a layer, and their length in hexahedra grows with the third root of the number. A hexahedron of the
// half eye at n = 14, with 7,350 of them, is in 20 pairs; on coarser eyes in no fewer.
double coupled_pairs(double coarser) {
  constexpr double of_each = 20, hexes_there = 7350;
  return of_each * coarser * std::max(1.0, std::cbrt(coarser / hexes_there));
}

// Nodal workspace of K; vectors. Of a refined mesh the matrix of checkerboard modes, and on one refined twice
// K's own lines. What setting it up needs besides is less than a Krylov basis that is still short.
double pressure_bytes(const Size& s, int refinements) {
  const double K = sizeof(NodeSingle) * s.nodes;
  if (refinements == 0) return K + 6 * number * s.hexes + 2 * number * s.nodes;
  const double pairs = coupled_pairs(s.hexes / (refinements == 1 ? 8 : 64));
  return refinements == 1 ? 72 * pairs : K + 15 * single * s.nodes + 54 * s.hexes + 408 * pairs;
}

// Blocks of 3 x 3 or 6 x 6 and their triplets on the way to MUMPS: a block's upper half, each number with its
// row and column.
double triplet_bytes(double rows, int block, double neighbours) {
  return 12 * block * block * neighbours / 2 * rows / block;
}

// MUMPS on the displacement block of a base mesh: its code and buffers, matrix and factors, measured on eyes,
// blocks and balls.
double base_bytes(const Size& s, const LinearSettings& l) {
  return 5 * megabyte + triplet_bytes(s.nodal(), 3, 27) +
         (l.smoothing == Precision::full ? 178 : 89) * std::pow(s.nodal(), 4.0 / 3);
}

void add_coarser_levels(const RunSize& size, const LinearSettings& l, std::vector<MemoryPart>& parts) {
  double levels = 0;
  for (std::size_t k = 1; k + 1 < size.levels.size(); ++k) {
    const Size& s = size.levels[k];
    levels += system_bytes(s, size.liquids, l) + smoother_bytes(s, l) + 3 * number * s.unknowns();
  }
  parts.push_back({"coarser levels", levels});
  parts.push_back({"base factors", base_bytes(size.levels.back(), l)});
}

// MUMPS's numbers for each aggregate, without symmetry twice as many: they grow with the neighbours, fewer
// where the body is thin, and with the separators, and so with the body's extent. Measured on blocks,
// cylinders, shells and eyes of 3,600 to 47,000 hexahedra.
double factors_of_aggregate(const Size& s) {
  const double round = sphericity(s.hexes, s.nodes), thin = std::min(1., .5 + .8 * round);
  return (thin * 1350 + 18 * round * std::cbrt(s.nodes)) * 16;
}

// Levels of aggregates: nineteen blocks a row with their columns, in single precision off the diagonal; in
// double those on it, their inverses, frames, weights and eight vectors; each further level has a sixth of
// the rows, and the last one is factorised in double precision, both triangles. While they are made there is
// no Krylov basis, which is larger than what the blocks are gathered in.
double levels_bytes(const Size& s, double aggregates, int factorised) {
  const double blocks = 19 * (36 * single + 4), of_aggregate = (2 * 36 + 24 + 36 + 8 * 6) * number;
  double last = aggregates;
  while (6 * last > factorised) last /= 6;
  return 1.2 * aggregates * (blocks + of_aggregate) + last * 4 * factors_of_aggregate(s);
}

bool has_levels(double aggregates, const LinearSettings& l) {
  return l.smoothing == Precision::single && 6 * aggregates > l.aggregation.factorised;
}

// 6 x 6 blocks of the aggregates' matrix: an aggregate is coupled with fifteen others (half eyes at n = 8 and
// 14: 7.9 and 8.1 blocks in the upper triangle).
double blocks_of(double aggregates, bool symmetric) { return (symmetric ? 8 : 15) * aggregates; }

// The blocks' triplets, and those in single precision, while the factors are made.
double aggregation_triplets(const Size& s, const LinearSettings& l, bool symmetric) {
  const double aggregates = s.nodes / l.aggregation.nodes;
  if (has_levels(aggregates, l)) return 0;
  return 36 * (2 * sizeof(int) + number + single) * blocks_of(aggregates, symmetric);
}

// The blocks and the factors, or the levels.
double aggregation_bytes(const Size& s, const LinearSettings& l, bool symmetric) {
  const double aggregates = s.nodes / l.aggregation.nodes;
  if (has_levels(aggregates, l)) return levels_bytes(s, aggregates, l.aggregation.factorised);
  const double factors =
      (l.smoothing == Precision::full ? 1.4 : 1) * (symmetric ? 1 : 2) * factors_of_aggregate(s);
  return factors * aggregates + (48 * number + 40) * blocks_of(aggregates, symmetric) +
         aggregation_triplets(s, l, symmetric);
}

// Of hypre's hierarchies, and of the nodes' blocks.
double coarse_bytes(Displacement name, const Size& s, const LinearSettings& l, bool symmetric) {
  if (name == Displacement::aggregation) return aggregation_bytes(s, l, symmetric);
  if (name == Displacement::jacobi) return 9 * 12 * s.nodes;
  return (name == Displacement::boomeramg || name == Displacement::boomeramg_nodal ? 2 * 27 * 9
                                                                                   : 2 * 27 * 3) *
         12 * s.nodes;
}

void add_direct(const RunSize& size, Direct library, std::vector<MemoryPart>& parts) {
  const Size& s = size.levels.front();
  const double both = library != Direct::mumps && size.symmetric ? lu_of_ldlt : 1;
  parts.push_back({"matrix and its copies", direct_matrix_bytes(s.hexes, size.symmetric)});
  parts.push_back(
      {"factors", both * direct_factor_bytes(s.unknowns(), s.hexes, s.nodes, size.ranks, size.symmetric)});
}

void add_iterative(const RunSize& size, const SolverSettings& solver, std::vector<MemoryPart>& parts) {
  const LinearSettings& l = solver.linear;
  const Size& s = size.levels.front();
  const bool hierarchy = size.levels.size() > 1;
  const Displacement name = l.displacement_on(hierarchy);
  parts.push_back({"operator", system_bytes(s, size.liquids, l)});
  parts.push_back({"smoother", smoother_bytes(s, l) + (1 + size.liquids) * number * s.nodal()});
  parts.push_back({"Krylov basis", krylov_bytes(s, solver, size.refinements)});
  if (!ends_early(solver.newton)) parts.push_back({"element pressures", pressure_bytes(s, size.refinements)});
  if (name == Displacement::multigrid && hierarchy)
    add_coarser_levels(size, l, parts);
  else
    parts.push_back({"coarse matrix", coarse_bytes(name, s, l, size.symmetric)});
}

// GMRES has ended when MUMPS begins, and the preconditioner is made.
double bytes_given_back(const RunSize& size, const SolverSettings& solver) {
  const Size& s = size.levels.front();
  const bool aggregates = solver.linear.displacement_on(size.levels.size() > 1) == Displacement::aggregation;
  return krylov_bytes(s, solver, size.refinements) +
         (aggregates ? aggregation_triplets(s, solver.linear, size.symmetric) : 0);
}

}  // namespace

double sum_of(const std::vector<MemoryPart>& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.,
                         [](double sum, const MemoryPart& p) { return sum + p.bytes; });
}

std::vector<MemoryPart> parts_of_solution(const RunSize& size, const Scene& scene) {
  const Size& s = size.levels.front();
  std::vector<MemoryPart> parts;
  // their code and buffers become resident when they are first called
  parts.push_back({"libraries at work", 10 * megabyte * size.ranks});
  // MUMPS sends fronts from rank to rank
  if (size.ranks > 1) parts.push_back({"message buffers", 8 * megabyte * size.ranks});
  // of a point: place, normal and area now, on trial, at the last search and at the start of the increment,
  // multipliers and history of its pieces, candidates, its block of the tangent; measured on the encircling
  // eye
  if (size.contact_points > 0) parts.push_back({"contacts", 800 * size.contact_points});
  // states at rest, before it, on trial and of a probe's beginning, right-hand side and solution
  parts.push_back(
      {"states and residuals", number * (scene.solver.stepping.extrapolate ? 6 : 5) * s.unknowns()});
  // the state that a step begins with; on their way to the file, nodes and hexahedra with their keys
  parts.push_back({"checkpoints",
                   scene.output.checkpoint > 0 ? 90 * s.nodes + 32 * s.hexes : 24 * s.nodes + 8 * s.hexes});
  if (scene.solver.linear.method == Method::direct)
    add_direct(size, scene.solver.linear.direct, parts);
  else
    add_iterative(size, scene.solver, parts);
  return parts;
}

double bytes_of_fallback(const RunSize& size, const Scene& scene) {
  const LinearSettings& l = scene.solver.linear;
  if (l.method == Method::direct || l.fallback != Fallback::direct) return 0;
  std::vector<MemoryPart> parts;
  add_direct(size, Direct::mumps, parts);
  return sum_of(parts) - bytes_given_back(size, scene.solver);
}

}  // namespace bulbus::inline app
