#pragma once
#include "core/base/pack.hpp"
#include "core/element/mean_tangent.hpp"
#include "core/element/semidefinite.hpp"

namespace bulbus::inline element {

/// What happens inside one pack of Q1/P0 elements. All integrals are over the reference element with unit
/// Gauss weights: dV0 = det ∂X/∂ξ, J dV0 = det ∂x/∂ξ.

template <class Body>
void for_each_gauss_point(Body body) {
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
#pragma GCC unroll 2
      for (int i = 0; i < 2; ++i) body(i, j, k);
}

/// Isochoric left Cauchy-Green tensor and reference volume of a Gauss point.
template <class T>
struct PointStrain {
  Sym3<T> b;
  T dV0;
};

/// b = J^(−2/3) F Fᵀ from the Jacobians a = ∂x/∂ξ (with its determinant) and A = ∂X/∂ξ.
template <class T>
PointStrain<T> point_strain(const Mat3<T>& a, const T& det_a, const Mat3<T>& A) {
  const Mat3<T> cof = cofactor(A);
  const T dV0 = determinant(A, cof), inverse = 1.0 / dV0;
  const Mat3<T> F = times_transposed(a, cof);  // a cof(A)ᵀ = F det A
  const T root = inverse_cube_root(T(det_a * inverse)) * inverse;
  return {gram(F, T(root * root)), dV0};
}

/// The strain of a pack's Gauss points, computed from the reference configuration too.
struct RecomputedStrain {
  ReferenceGradient<Pack> A;
  /// a = ∂x/∂ξ, det = det a
  PointStrain<Pack> at(int i, int j, int k, const Mat3<Pack>& a, const Pack& det) const {
    const Mat3<Pack> reference = A.at(i, j, k), cof = cofactor(reference);
    const Pack dV0 = determinant(reference, cof);
    const Pack product = det * dV0 * dV0,
               root = inverse_cube_root(Pack(product * product));  // (det² dV0⁴)^(-1/3) = J^(-2/3) / dV0²
    return {gram(times_transposed(a, cof), root), dV0};
  }
};

/// Floats kept per element and Gauss point by the cache: b and dV0.
constexpr int cached_floats = 7;
constexpr int pack_floats = 8 * cached_floats * lanes;

/// The strain of a pack's Gauss points, read from the cache (7 floats a point and lane).
struct CachedStrain {
  const float* data;
  PointStrain<Pack> at(int i, int j, int k, const Mat3<Pack>&, const Pack&) const {
    const float* p = data + (i + 2 * j + 4 * k) * cached_floats * lanes;
    prefetch(p + pack_floats, cached_floats * lanes);
    PointStrain<Pack> s;
    for (int c = 0; c < 6; ++c) s.b.v[c] = load(p + c * lanes);
    s.dV0 = load(p + 6 * lanes);
    return s;
  }
};

/// Internal forces Σ (τ_dev + λJ I) : ∇ₓv dV0 of a pack, and its current volumes.
template <class Material>
NodalVectors<Pack> internal_force(const Material& material, const ReferenceGradient<Pack>& x,
                                  const ReferenceGradient<Pack>& X, const Pack& lambda, Pack& volume) {
  ReferenceGradient<Pack> flux{};
  volume = 0;
  for_each_gauss_point([&](int i, int j, int k) {
    const Mat3<Pack> a = x.at(i, j, k), cof = cofactor(a);
    const Pack det = determinant(a, cof), inverse = 1.0 / det;
    volume += det;
    const PointStrain<Pack> s = point_strain(a, det, X.at(i, j, k));
    const Sym3<Pack> tau = material.deviatoric(s.b);
    Mat3<Pack> q;  // (τ dV0) a⁻ᵀ, and a⁻ᵀ = cof / det
    const Pack scale = s.dV0 * inverse;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        q(r, c) = scale * (tau(r, 0) * cof(0, c) + tau(r, 1) * cof(1, c) + tau(r, 2) * cof(2, c)) +
                  lambda * cof(r, c);
    flux.add(i, j, k, q);
  });
  return nodal(transposed_gradient(flux));
}

/// Action of a pack's tangent: forces K δx + b (δλ + γ W θ), where θ = bᵀ δx, b = ∂V_e/∂u, is returned too.
/// `penalty` is γ W = γ μ_e / V0_e.
template <class P, class Material, class Strain>
NodalVectors<P> tangent_action(const Material& material, const Strain& strain, const NodalVectors<P>& x,
                               const NodalVectors<P>& dx, const P& lambda, const P& dlambda, const P& penalty,
                               P& theta) {
  const Modes<P> place = modes(x), change = modes(dx), b = volume_gradient(place);
  theta = volume_change(b, change);
  const ReferenceGradient<P> gx = reference_gradient(place), gd = reference_gradient(change);
  ReferenceGradient<P> flux{};
  for_each_gauss_point([&](int i, int j, int k) {
    const Mat3<P> a = gx.at(i, j, k), cof = cofactor(a);
    const P det = determinant(a, cof), inverse = 1.0 / det;
    const PointStrain<P> s = strain.at(i, j, k, a, det);
    const Mat3<P> l = times_transposed(gd.at(i, j, k), cof);  // l det
    // T is linear in l: hand over l det and divide once. Everything carries one more 1/det for a⁻ᵀ = cof /
    // det.
    flux.add_product(i, j, k, material.tangent(s.b, l, P(s.dV0 * inverse * inverse), P(lambda * inverse)),
                     cof);
  });
  Modes<P> force = transposed_gradient(flux);
  add_pressure(b, P(dlambda + penalty * theta), force);
  return nodal(force);
}

/// The mean tangent of a pack, and the rest of λ: what is too large beside the shear modulus to be taken in.
/// Where it is clearly indefinite without its pressure, it is limited to what is not: the pressure's part
/// cancels between neighbours and says nothing.
template <class Material>
MeanTangent<Pack> mean_tangent(const Material& material, const ReferenceGradient<Pack>& x,
                               const ReferenceGradient<Pack>& X, const Pack& lambda,
                               const Pack& shear_modulus, Pack& rest) {
  for (int l = 0; l < lanes; ++l) rest.v[l] = std::abs(lambda[l]) <= 10 * shear_modulus[l] ? 0 : lambda[l];
  const Pack taken = lambda - rest;
  MeanTangent<Pack> C{};
  PressureTangent of_pressure{};
  for_each_gauss_point([&](int i, int j, int k) {
    const Mat3<Pack> a = x.at(i, j, k), cof = cofactor(a);
    const Pack det = determinant(a, cof), inverse = 1.0 / det;
    const PointStrain<Pack> s = point_strain(a, det, X.at(i, j, k));
    const Pack weight = s.dV0 * inverse * inverse, pressure = taken * inverse;
    for (int f = 0; f < 3; ++f) {
      const int e = (f + 2) % 3, d = (f + 1) % 3;  // (d, e, f) is cyclic
      for (int c = 0; c < 3; ++c) {
        Mat3<Pack> l{};
        for (int q = 0; q < 3; ++q) l(c, q) = cof(q, f);
        const Mat3<Pack> t = material.tangent(s.b, l, weight, pressure);
        const auto row = [&](int r, int along) {
          return t(r, 0) * cof(0, along) + t(r, 1) * cof(1, along) + t(r, 2) * cof(2, along);
        };
        for (int r = 0; r <= c; ++r) C.along[f](r, c) += row(r, f);
        for (int r = 0; r < 3; ++r) C.across[d](r, c) += row(r, e);
      }
    }
    add_pressure_tangent(cof, pressure, of_pressure);
  });
  limit_to_semidefinite(C, of_pressure);
  return C;
}

}  // namespace bulbus::inline element
