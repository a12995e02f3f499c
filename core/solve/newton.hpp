#pragma once
#include <string>
#include <vector>

#include "core/solve/linear_solver.hpp"

namespace bulbus::inline solve {

enum class Outcome {
  converged,
  inverted_element,
  linear_solver_failed,
  too_large,
  too_many_iterations,
  cycling,
  not_finite,
  inadmissible,
  interrupted
};

/// In words, for logs and summaries.
std::string describe(Outcome outcome);

/// Of a solution, relative (LinearReport::curvature): between it and minus it, the tolerance of a linear
/// solve may have made the sign.
inline constexpr double least_curvature = 1e-2;

/// One Newton iteration as it is reported: the equilibrium error before it and the linear solve it made.
struct NewtonIteration {
  int number = 0;
  EquilibriumError error;
  double prescribed = 0;  ///< largest prescribed increment still to be made, mm
  double tolerance = 0;   ///< of the linear solve
  LinearReport linear;
  double step = 0;  ///< part of the Newton step that was taken
};

struct NewtonReport {
  Outcome outcome = Outcome::converged;
  std::string reason;
  EquilibriumError error;  ///< of the state that was reached
  std::vector<NewtonIteration> iterations;
  int krylov_iterations = 0;        ///< those of linear solves that failed too
  int negative_pivots = -1;         ///< of the last linearisation; -1 where nobody counted them
  bool negative_curvature = false;  ///< of the last solution of GMRES, where pivots are not known
  int direct_solves = 0;            ///< systems that MUMPS solved in place of GMRES
  bool too_long = false;            ///< given up since the increment is too long for the mesh
};

using NewtonObserver = std::function<void(const NewtonIteration&)>;

/// Brings `state` to equilibrium at the progress that the problem was set to, with the tangent that `linear`
/// describes. On failure the state is not to be used. Full steps, shortened where an element would invert,
/// and one where two states follow one another (CycleDetector); linear tolerances are those of ForcingTerm.
/// Collective.
NewtonReport newton(Problem& problem, const LinearSettings& linear, LinearSolver& solver, State& state,
                    double progress, const NewtonSettings& settings, Profiler& profiler,
                    const NewtonObserver& observer = {});

}  // namespace bulbus::inline solve
