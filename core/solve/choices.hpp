#pragma once
#include <array>
#include <string_view>

#include "core/base/words.hpp"
#include "core/solve/linear_operator.hpp"

namespace bulbus::inline solve {

/// What solves a linear system: GMRES, or a sparse direct solver.
enum class Method { iterative, direct };
constexpr std::array<std::string_view, 2> words(Method) { return {"iterative", "direct"}; }

/// Sparse direct solvers.
enum class Direct { mumps, superlu_dist, umfpack, eigen };
constexpr std::array<std::string_view, 4> words(Direct) {
  return {"mumps", "superlu_dist", "umfpack", "eigen"};
}

/// Orders of elimination that MUMPS offers; `automatic` is its own choice among them.
enum class Ordering { scotch, metis, amd, qamd, pord, automatic };
constexpr std::array<std::string_view, 6> words(Ordering) {
  return {"scotch", "metis", "amd", "qamd", "pord", "auto"};
}

/// What improves the solution that factors give.
enum class Refinement { none, gmres };
constexpr std::array<std::string_view, 2> words(Refinement) { return {"none", "gmres"}; }

/// How the pressures of liquids enter a linear system: as unknowns, or eliminated.
enum class Formulation { bordered, eliminated };
constexpr std::array<std::string_view, 2> words(Formulation) { return {"bordered", "eliminated"}; }

/// Preconditioners of the displacement block. `automatic` depends on the mesh: see
/// LinearSettings::displacement_on.
enum class Displacement {
  automatic,
  aggregation,
  multigrid,
  hybrid,
  scalar_amg,
  boomeramg,
  boomeramg_nodal,
  jacobi,
  exact
};
constexpr std::array<std::string_view, 9> words(Displacement) {
  return {"auto",      "aggregation",     "multigrid", "hybrid", "scalar_amg",
          "boomeramg", "boomeramg_nodal", "jacobi",    "exact"};
}

/// How often multigrid visits a coarser level for once on the next finer one: once, or twice.
enum class Cycle { v, w };
constexpr std::array<std::string_view, 2> words(Cycle) { return {"V", "W"}; }

/// What is kept of the tangent between its products: nothing, the strain in single precision, or 3 x 3
/// blocks.
enum class TangentStorage { recompute, cache, assembled };
constexpr std::array<std::string_view, 3> words(TangentStorage) {
  return {"recompute", "cache", "assembled"};
}

/// What solves a system that GMRES did not.
enum class Fallback { direct, none };
constexpr std::array<std::string_view, 2> words(Fallback) { return {"direct", "none"}; }

/// Presets of the solver: see SolverSettings::accuracy_help.
enum class Accuracy { fast, balanced, tight };
constexpr std::array<std::string_view, 3> words(Accuracy) { return {"fast", "balanced", "tight"}; }

constexpr std::array<std::string_view, 2> words(Precision) { return {"double", "single"}; }

}  // namespace bulbus::inline solve
