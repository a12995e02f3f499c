#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/problem/spec/reference_spec.hpp"
#include "core/solve/newton.hpp"

namespace bulbus::inline solve {

/// One iteration of the search for the unloaded reference.
struct UnloadedIteration {
  int number = 0;        ///< over the whole search, from 1
  double load = 1;       ///< part of the loads
  double distance = 0;   ///< of a node from its drawn position once the loads act, the largest, mm
  double ratio = 0;      ///< to the distance before; 0: there is none
  double tolerance = 0;  ///< of the linear solve
  int krylov_iterations = 0;
  int negative_pivots = -1;  ///< of the direct solver
};

/// What became of the search.
struct UnloadedReport {
  bool found = false;
  std::string reason;  ///< why not
  int signal = 0;      ///< that interrupted it; 0: none did
  int iterations = 0, krylov_iterations = 0, divisions = 0;
  double distance = 0;   ///< the last, mm
  double way = 0;        ///< largest distance between drawn and unloaded positions, mm
  double curvature = 0;  ///< of the last solution (LinearReport)
  int negative_pivots = -1;
  double seconds = 0;
  std::shared_ptr<State> loaded;  ///< in which the loads hold the drawn positions; null if it is not found
};

/// What the search solves with: a solver for every iteration.
struct UnloadedSolver {
  LinearSettings linear;
  std::function<std::unique_ptr<LinearSolver>()> make;
  Profiler& profiler;
};

using UnloadedObserver = std::function<void(const UnloadedIteration&)>;

/// Moves the reference positions of the meshes so that the loads of the model's only step bring every node to
/// where it is drawn, within the tolerance (formulation, section 4.3). If it is not found the meshes are as
/// they were. Collective. Throws InputError.
UnloadedReport find_unloaded(std::vector<MeshLevel>& levels, const Model& model, const ReferenceSpec& spec,
                             const UnloadedSolver& solver, const UnloadedObserver& observer);

/// Largest distance of a node's two positions (3 numbers per local node), mm. Collective.
double largest_distance(const LocalMesh& mesh, std::span<const double> a, std::span<const double> b);

}  // namespace bulbus::inline solve
