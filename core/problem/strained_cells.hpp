#pragma once
#include <string>

#include "core/problem/problem.hpp"

namespace bulbus::inline problem {

/// Hexahedra whose deformation bodes ill, the same on every rank.
struct StrainedCells {
  std::string unstable_region;  ///< the first with hexahedra in which its law has lost stability; empty: none
  long long unstable = 0;       ///< how many of that region, judged in their middles
  std::string squeezed_region;  ///< of the hexahedron with the smallest Jacobian of a Gauss point
  long long squeezed = 0;       ///< its number in the mesh that was read, from 1
  double least_jacobian = 1;
};

/// Of the positions x of the local nodes. Collective.
StrainedCells strained_cells(const Problem& problem, std::span<const double> x);

}  // namespace bulbus::inline problem
