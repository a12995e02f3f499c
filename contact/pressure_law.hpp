#pragma once

namespace bulbus {

/// Contact pressure as a function of the trial pressure τ = p − α_A G, MPa, with its derivative and integral.
struct ContactPressure {
  double value = 0, slope = 0, integral = 0;
};

/// max(0, τ); with a width, a parabola over |τ| < width joins the two branches with a continuous slope.
inline ContactPressure contact_pressure(double tau, double width = 0) {
  if (tau <= -width) return {};
  if (tau >= width) return {tau, 1, (tau * tau + width * width / 3) / 2};
  const double above = tau + width;
  return {above * above / (4 * width), above / (2 * width), above * above * above / (12 * width)};
}

}  // namespace bulbus
