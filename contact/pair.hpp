#pragma once
#include <array>

#include "core/base/tensor.hpp"

namespace bulbus {

using Triangle = std::array<Vec3<double>, 3>;

/// A slave node x above or below a master triangle x1 x2 x3 and its perpendicular foot in the triangle's plane
/// (formulation, section 5):
///     n = e1×e2/j,  G = (x − x1)·n,  t¹ = e2×n/j,  t² = n×e1/j,  L2 = t¹·(x−x1),  L3 = t²·(x−x1),  L1 = 1 − L2 − L3
struct Pair {
  double gap;                         ///< G, mm; negative inside the master
  Vec3<double> normal;                ///< out of the master
  std::array<double, 3> weights;      ///< L of the foot; negative beyond an edge
  std::array<Vec3<double>, 2> duals;  ///< t¹, t² (1/mm)
};

/// The triangle must have an area.
Pair project(const Vec3<double>& x, const Triangle& corners);

/// D = ∂G/∂(x, x1, x2, x3) = [n; −L1 n; −L2 n; −L3 n]
std::array<double, 12> gradient(const Pair& pair);

/// a D Dᵀ + b H with H = ∂²G/∂u², by rows. The potential φ(G) has the tangent a = φ'', b = φ'.
std::array<double, 144> tangent(const Pair& pair, double a, double b);

}  // namespace bulbus
