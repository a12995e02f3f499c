#pragma once
#include "core/base/pack.hpp"
#include "core/element/q1.hpp"

namespace bulbus {

/// What happens inside one pack of Q1/P0 elements. All integrals are over the reference element with unit Gauss weights:
/// dV0 = det ∂X/∂ξ, J dV0 = det ∂x/∂ξ.

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

/// The strain of a pack's Gauss points, computed from both configurations.
struct RecomputedStrain {
  ReferenceGradient<Pack> A;
  PointStrain<Pack> at(int i, int j, int k, const Mat3<Pack>& a, const Pack& det_a) const {
    return point_strain(a, det_a, A.at(i, j, k));
  }
};

/// Floats kept per element and Gauss point by the cache: b and dV0.
constexpr int cached_floats = 7;

/// The strain of a pack's Gauss points, read from the cache (7 floats a point and lane).
struct CachedStrain {
  const float* data;
  PointStrain<Pack> at(int i, int j, int k, const Mat3<Pack>&, const Pack&) const {
    const float* p = data + (i + 2 * j + 4 * k) * cached_floats * lanes;
    PointStrain<Pack> s;
    for (int c = 0; c < 6; ++c) s.b.v[c] = load(p + c * lanes);
    s.dV0 = load(p + 6 * lanes);
    return s;
  }
};

template <class Body>
void for_each_gauss_point(Body body) {
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) body(i, j, k);
}

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
        q(r, c) = scale * (tau(r, 0) * cof(0, c) + tau(r, 1) * cof(1, c) + tau(r, 2) * cof(2, c)) + lambda * cof(r, c);
    flux.add(i, j, k, q);
  });
  return transposed_gradient(flux);
}

/// Action of a pack's tangent: forces K δx + b (δλ + γ W θ), where θ = bᵀ δx, b = ∂V_e/∂u, is returned too.
/// `penalty` is γ W = γ μ_e / V_e.
template <class Material, class Strain>
NodalVectors<Pack> tangent_action(const Material& material, const Strain& strain, const ReferenceGradient<Pack>& x,
                                  const ReferenceGradient<Pack>& dx, const Pack& lambda, const Pack& dlambda,
                                  const Pack& penalty, Pack& theta) {
  struct Kinematics {
    Mat3<Pack> cof, l;
    Pack det;
  };
  std::array<Kinematics, 8> points;
  theta = 0;
  for_each_gauss_point([&](int i, int j, int k) {
    Kinematics& p = points[i + 2 * j + 4 * k];
    const Mat3<Pack> a = x.at(i, j, k);
    p.cof = cofactor(a);
    p.det = determinant(a, p.cof);
    p.l = times_transposed(dx.at(i, j, k), p.cof);  // l det
    theta += trace(p.l);
  });
  const Pack pressure = dlambda + penalty * theta;
  ReferenceGradient<Pack> flux{};
  for_each_gauss_point([&](int i, int j, int k) {
    const Kinematics& p = points[i + 2 * j + 4 * k];
    const Pack inverse = 1.0 / p.det;
    const PointStrain<Pack> s = strain.at(i, j, k, x.at(i, j, k), p.det);
    // T is linear in l: hand over l det and divide once. Everything carries one more 1/det for a⁻ᵀ = cof / det.
    Mat3<Pack> t = material.tangent(s.b, p.l);
    const Pack scale = s.dV0 * inverse * inverse, volumetric = lambda * inverse;
    const Pack spherical = volumetric * trace(p.l) + pressure;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) t(r, c) = scale * t(r, c) - volumetric * p.l(c, r);
      t(r, r) += spherical;
    }
    flux.add(i, j, k, t * p.cof);
  });
  return transposed_gradient(flux);
}

}  // namespace bulbus
