#pragma once
#include "core/solve/march.hpp"
#include "tests/support/models.hpp"

namespace bulbus {

/// A march through a scene and all that it left behind.
struct MarchTrial : MarchObserver {
  Comm comm;
  Problem problem;
  SolverSettings settings;
  Profiler profiler;
  State state;
  MarchReport report;
  std::vector<Increment> increments;

  MarchTrial(const Scene& scene, const Comm& c, const NewtonSettings& newton)
      : comm(c), problem(scene.mesh, scene.model, c), state(problem.initial_state()) {
    settings.newton = newton;
  }
  void increment_done(const Increment& i, const State&) override { increments.push_back(i); }
  void march_with(std::unique_ptr<LinearSolver> solver) {
    report = march(problem, *solver, state, settings, profiler, *this);
  }
  /// Local nodes (ghosts included) of a set of nodes of the mesh, in use by the model or not.
  std::vector<int> nodes(const Mesh& mesh, const std::string& set) const {
    return problem.mesh().local(nodes_of(mesh, set));
  }
};

}  // namespace bulbus
