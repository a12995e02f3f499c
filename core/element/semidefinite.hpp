#pragma once
#include "core/base/pack.hpp"
#include "core/element/mean_tangent.hpp"

namespace bulbus::inline element {

/// What a pressure adds to a mean tangent: nothing along, and skew matrices across, by their axial vectors,
/// λ/det (cof_e × cof_f) for every cyclic (d, e, f).
using PressureTangent = std::array<Vec3<Pack>, 3>;

/// += the share of a Gauss point; `factor`: λ / det a, `cof`: cofactor of a.
inline void add_pressure_tangent(const Mat3<Pack>& cof, const Pack& factor, PressureTangent& P) {
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      P[d][k] += factor * (cof(i, e) * cof(j, f) - cof(j, e) * cof(i, f));
    }
  }
}

/// Adds to C, as a matrix of 9 × 9, what makes C − P positive semidefinite in those elements where an
/// eigenvalue of it lies clearly below zero. The others' numbers do not change.
void limit_to_semidefinite(MeanTangent<Pack>& C, const PressureTangent& P);

}  // namespace bulbus::inline element
