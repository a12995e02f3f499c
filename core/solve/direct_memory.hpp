#pragma once
#include <cmath>

namespace bulbus {

/// Bytes over all ranks that MUMPS takes for the coupled system, measured on eyes of 7,000 hexahedra and more: for the matrix and its
/// copies, and for the factors, which of a compact body grow with the power 4/3 of the unknowns.
inline double direct_matrix_bytes(double hexahedra) { return 11e3 * hexahedra; }
inline double direct_factor_bytes(double unknowns) { return 160 * std::pow(unknowns, 4.0 / 3); }

}  // namespace bulbus
