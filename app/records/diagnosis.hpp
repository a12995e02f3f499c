#pragma once
#include <optional>
#include <string>

#include "app/records/alternating_pressures.hpp"
#include "core/solve/newton.hpp"

namespace bulbus::inline app {

/// What is known of a run that did not converge, in its last converged state.
struct FailureFacts {
  Outcome outcome = Outcome::converged;  ///< of the last attempt
  std::string reason;                    ///< of its failure
  std::string step;
  double progress = 0;          ///< part of the step that converged
  bool pressure_grows = false;  ///< the step changes a given pressure
  std::string liquid;   ///< whose pressure is given and grows; empty: a pressure on a surface, or none
  double pressure = 0;  ///< of that liquid, MPa
  double softening =
      1;  ///< slope of the response (volume or displacement) over the step's progress, last to first
  int surplus_pivots = 0;        ///< negative pivots of the last tangent beyond those of a stable equilibrium
  double largest_pressure = 0;   ///< given at the end of the step, over the largest shear modulus
  std::string unstable_region;   ///< a region with hexahedra beyond the stability of its law
  long long unstable_hexes = 0;  ///< how many
  std::string squeezed_region;   ///< of the hexahedron with the smallest Jacobian
  long long squeezed_hex = 0;    ///< its number, from 1
  double least_jacobian = 1;
  double displacement = 0;  ///< largest, over the model's size
  std::optional<AlternatingPressures> alternating;
  bool contacts = false, touching = false;
  bool direct = false;  ///< the linear solver is
};

/// One line: the most likely cause, and what to try. Never empty.
std::string diagnosis(const FailureFacts& facts);

}  // namespace bulbus::inline app
