#pragma once
#include <memory>

#include "core/solve/newton.hpp"

namespace bulbus::bench {

/// The half eye of data/scenes/half_eye.yaml: step 0 brings it to 15 mmHg in one increment, step 1 encloses
/// the liquid and moves the equator's band 2 mm inwards in four.
Model half_eye_model();
/// On the mesh of `n`, refined `refine` times.
std::unique_ptr<Problem> half_eye(int n, const Comm& comm, int refine = 0);

/// 15 mmHg, reached with the default iterative solver. Throws std::runtime_error if it is not.
State pressurised(Problem& problem, const SolverSettings& settings, Profiler& profiler);

/// What a Newton step of the first coupled increment (a quarter of step 1) starts from.
struct FirstIncrement {
  Residual residual;
  std::vector<double> prescribed;  ///< prescribed displacements still to be made
};
FirstIncrement first_increment(Problem& problem, State& pressurised);

/// Of all ranks.
long long unknowns(const Problem& problem);

}  // namespace bulbus::bench
