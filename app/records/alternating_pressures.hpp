#pragma once
#include <optional>
#include <string>

#include "core/problem/problem.hpp"

namespace bulbus::inline app {

/// Checkerboard modes of the element pressures of a region.
struct AlternatingPressures {
  std::string region;
  double amplitude;  ///< MPa
  double ratio;      ///< amplitude over the initial shear modulus
};

/// Of the region in which element pressures alternate from hexahedron to hexahedron by the largest part of
/// its shear modulus; none if nowhere by so much that its equilibrium may be that of the checkerboard.
/// Collective.
std::optional<AlternatingPressures> alternating_pressures(const Problem& problem, const State& state);

/// What it means and what to do: a sentence without a full stop.
std::string sentence(const AlternatingPressures& pressures);

}  // namespace bulbus::inline app
