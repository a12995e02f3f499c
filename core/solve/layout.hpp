#pragma once
#include <span>

namespace bulbus::inline solve {

/// One rank's part of an unknown vector: [3 per owned node | 6 per rigid body, on rank 0 | 1 per hexahedron |
/// 1 per liquid, on rank 0].
struct Layout {
  int nodal = 0, bodies = 0, hexes = 0, liquids = 0;
  int primal() const { return nodal + bodies; }
  int size() const { return nodal + bodies + hexes + liquids; }
  template <class V>
  auto primal(V&& v) const {
    return std::span(v).subspan(0, primal());
  }
  template <class V>
  auto lambda(V&& v) const {
    return std::span(v).subspan(primal(), hexes);
  }
  template <class V>
  auto pressures(V&& v) const {
    return std::span(v).subspan(primal() + hexes, liquids);
  }
};

}  // namespace bulbus::inline solve
