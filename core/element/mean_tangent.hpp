#pragma once
#include "core/base/pack.hpp"
#include "core/element/q1.hpp"

namespace bulbus::inline element {

/// A hexahedron's tangent with the mean over its Gauss points of what couples reference gradients,
///
///     C_de = Σ cof(a)_d T(e ⊗ cof(a)_e)      3×3 blocks between ∂u/∂ξ_d and ∂u/∂ξ_e, C_ed = C_deᵀ.
///
/// Exact between displacements that are linear in ξ, and where C does not vary; what it couples of different
/// modes is lost. As an integral of products of modes it needs no Gauss points. It takes pressure in, too,
/// unless that is many times the shear modulus: then λ ∂²V/∂x² is kept exact besides.
template <class T>
struct MeanTangent {
  std::array<Sym3<T>, 3> along;   ///< C_dd
  std::array<Mat3<T>, 3> across;  ///< C_ef, where (d, e, f) is cyclic
};

/// What smoothers keep of sixteen hexahedra.
struct SingleTangent {
  MeanTangent<SinglePack> C;
  SinglePack lambda, penalty;  ///< what C lacks of the pressure; γ W
  bool curved;                 ///< is there such a λ?
};

/// += C u for the coefficients of one displacement.
template <class T>
void add_product(const Sym3<T>& C, const Vec3<T>& u, Vec3<T>& f) {
  for (int i = 0; i < 3; ++i) f[i] = f[i] + C(i, 0) * u[0] + C(i, 1) * u[1] + C(i, 2) * u[2];
}
template <class T>
void add_product(const Mat3<T>& C, const Vec3<T>& u, Vec3<T>& f) {
  for (int i = 0; i < 3; ++i) f[i] = f[i] + C(i, 0) * u[0] + C(i, 1) * u[1] + C(i, 2) * u[2];
}
template <class T>
void add_transposed_product(const Mat3<T>& C, const Vec3<T>& u, Vec3<T>& f) {
  for (int i = 0; i < 3; ++i) f[i] = f[i] + C(0, i) * u[0] + C(1, i) * u[1] + C(2, i) * u[2];
}

/// Its forces on the modes. The gradient along ξ_d has linear_d, twist_f ξ_e + twist_e ξ_f and warp ξ_e ξ_f,
/// whose squares have the means 1, 1/3 and 1/9.
template <class T>
Modes<T> action(const MeanTangent<T>& C, const Modes<T>& u) {
  Modes<T> f{};
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, g = (d + 2) % 3;
    add_product(C.along[d], u.linear[d], f.linear[d]);
    add_product(C.along[d], u.twist[e], f.twist[e]);
    add_product(C.along[d], u.twist[g], f.twist[g]);
    add_product(C.along[d], u.warp, f.warp);
    add_product(C.across[d], u.linear[g], f.linear[e]);
    add_transposed_product(C.across[d], u.linear[e], f.linear[g]);
    add_product(C.across[d], u.twist[e], f.twist[g]);
    add_transposed_product(C.across[d], u.twist[g], f.twist[e]);
  }
  for (int d = 0; d < 3; ++d)
    for (int c = 0; c < 3; ++c) f.twist[d][c] = (1. / 3) * f.twist[d][c];
  for (int c = 0; c < 3; ++c) f.warp[c] = (1. / 9) * f.warp[c];
  return f;
}

}  // namespace bulbus::inline element
