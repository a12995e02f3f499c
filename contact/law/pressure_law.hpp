#pragma once

namespace bulbus::inline contact {

/// Contact pressure as a function of the trial pressure τ = p − α_A G, MPa, with its derivative and integral.
struct ContactPressure {
  double value = 0, slope = 0, integral = 0;
};

/// max(0, τ)
inline ContactPressure contact_pressure(double tau) {
  return tau > 0 ? ContactPressure{tau, 1, tau * tau / 2} : ContactPressure{};
}

/// Greatest tension of a pair that stays active, in predicted pressures. Any number gives the same converged
/// state.
inline constexpr double most_tension = 100;

/// Does a pair stay active whose last linear solution predicted the pressure p, MPa? In terms of primal-dual
/// active sets p − c (G + p/α) > 0 with c = α/(1 + most_tension): the pressure decides, not the sign of a gap
/// that the next step closes.
inline bool still_active(double tau, double predicted) {
  return predicted > 0 && tau > -most_tension * predicted;
}

}  // namespace bulbus::inline contact
