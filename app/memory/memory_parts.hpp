#pragma once
#include <string>
#include <vector>

#include "app/scene/scene.hpp"

namespace bulbus::inline app {

/// A part of the memory that a run will need at its peak, bytes over all ranks.
struct MemoryPart {
  std::string name;
  double bytes;
};

double sum_of(const std::vector<MemoryPart>& parts);

/// What a run's memory depends on, summed over ranks: numbers of nodes and hexahedra, those that ranks share
/// counted on each.
struct RunSize {
  struct Level {
    double nodes, hexes;
    double nodal() const { return 3 * nodes; }
    double unknowns() const { return nodal() + hexes; }
  };
  std::vector<Level> levels;  ///< the finest first, then the coarser ones that multigrid uses
  double liquids = 0, contact_points = 0;
  int refinements = 0, ranks = 1;
  bool symmetric = true;  ///< is the tangent, so that half of matrices and factors are kept?
};

/// What states, operator, preconditioner and Krylov method or factors add to program, mesh and problem.
std::vector<MemoryPart> parts_of_solution(const RunSize& size, const Scene& scene);

/// What MUMPS adds to them, bytes, while it solves a system that GMRES did not; 0 where
/// `solver.linear.fallback` or `method` says that it never does.
double bytes_of_fallback(const RunSize& size, const Scene& scene);

}  // namespace bulbus::inline app
