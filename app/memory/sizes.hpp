#pragma once
#include <string>
#include <vector>

#include "core/mesh/quality.hpp"
#include "core/problem/problem.hpp"

namespace bulbus::inline app {

/// How large a problem is, over all ranks, and its unknowns by kind at the present step.
struct Sizes {
  long long hexahedra = 0, nodes = 0, bars = 0;
  long long displacement = 0;      ///< free directions of nodes
  long long element_pressure = 0;  ///< of deformable hexahedra
  long long liquid_pressure = 0;
  long long rigid = 0;  ///< free motions of rigid bodies
  long long unknowns() const { return displacement + element_pressure + liquid_pressure + rigid; }
};

/// Collective.
Sizes sizes_of(const Problem& problem);

/// Negative pivots that a symmetric factorisation has at a stable equilibrium: one per hexahedron and liquid.
long long stable_pivots(const Problem& problem);

/// Tables for people.
std::vector<std::string> lines_of(const Sizes& sizes);
std::vector<std::string> lines_of(const std::vector<RegionQuality>& quality);
/// Volumes of the liquids before the first step, of the whole. Collective.
std::vector<std::string> liquid_lines(const Problem& problem);

}  // namespace bulbus::inline app
