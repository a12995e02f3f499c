#pragma once
#include <string>
#include <vector>

namespace bulbus {

/// What a number measures. Everything inside is mm, N, MPa (and mm², mm³, rad).
enum class Quantity { number, length, area, volume, force, stress, angle, time };

/// Name of the unit in which a quantity is kept: "mm", "MPa", ...; empty for a plain number.
std::string unit_of(Quantity q);

/// Names of all units of a quantity, the kept one first.
std::vector<std::string> units_of(Quantity q);

/// Reads "15", "15 mmHg", "0.5e-3 m" into the kept unit.
/// Throws std::invalid_argument with a message if the text is no number or the unit does not measure `q`.
double parse_quantity(const std::string& text, Quantity q);

constexpr double mmHg = 1.333223684e-4;  ///< MPa (15 mmHg = 1.99984e-3 MPa)

}  // namespace bulbus
