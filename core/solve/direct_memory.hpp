#pragma once
#include <algorithm>
#include <cmath>

namespace bulbus::inline solve {

/// Bytes over all ranks that MUMPS takes for the coupled system beside the factors: triplets, their copy in
/// the order of the fronts, analysis and the front under way. Measured on blocks, cylinders, shells and eyes
/// of 3,600 to 13,000 hexahedra: 7.4e3 to 8.5e3 for each (benchmarks/notebook/memory.md); without symmetry
/// there is the other triangle besides.
inline double direct_matrix_bytes(double hexahedra, bool symmetric) {
  return (symmetric ? 8e3 : 16e3) * hexahedra;
}

/// How round a body is: 6 hexahedra^(2/3) over the faces of its boundary, 2 (nodes − hexahedra) in number. 1
/// for a cube, 0.6 for the half eye, 0.4 for a shell of three layers.
inline double sphericity(double hexahedra, double nodes) {
  return std::min(1.5, 3 * std::cbrt(hexahedra * hexahedra) / std::max(nodes - hexahedra, 1.0));
}

/// Bytes of the factors: by nested dissection they grow with the power 4/3 of the unknowns, and with the size
/// of the separators, which are smaller where a body is thin. Measured within 10 %; on several ranks fronts
/// are kept in larger pieces. L U has twice the numbers of L D Lᵀ.
inline double direct_factor_bytes(double unknowns, double hexahedra, double nodes, int ranks,
                                  bool symmetric) {
  return (68 + 98 * sphericity(hexahedra, nodes)) * std::pow(unknowns, 4.0 / 3) * (ranks > 1 ? 1.2 : 1) *
         (symmetric ? 1 : 2);
}

/// Times as much by a solver that keeps L and U of a symmetric matrix.
constexpr double lu_of_ldlt = 2.5;

}  // namespace bulbus::inline solve
