#pragma once
#include "core/base/pack.hpp"
#include "core/element/q1.hpp"

namespace bulbus {

/// What happens inside one pack of Q1/P0 elements. All integrals are over the reference element with unit Gauss weights:
/// dV0 = det ∂X/∂ξ, J dV0 = det ∂x/∂ξ.

template <class Body>
void for_each_gauss_point(Body body) {
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
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

/// One number per Gauss point i + 2j + 4k of a pack.
template <class P>
using PointValues = std::array<P, 8>;

/// The strain of a pack's Gauss points, computed from both configurations. Divisions and roots, which take long but can overlap,
/// are done for all points at once.
class RecomputedStrain {
 public:
  RecomputedStrain(const ReferenceGradient<Pack>& A, const PointValues<Pack>& det_a) {
    for_each_gauss_point([&](int i, int j, int k) {
      const int p = i + 2 * j + 4 * k;
      const Mat3<Pack> a = A.at(i, j, k);
      cofactor_[p] = cofactor(a);
      dV0_[p] = determinant(a, cofactor_[p]);
    });
    for (int p = 0; p < 8; ++p) {
      const Pack inverse = 1.0 / dV0_[p], root = inverse_cube_root(det_a[p] * inverse) * inverse;
      factor_[p] = root * root;
    }
  }
  PointStrain<Pack> at(int i, int j, int k, const Mat3<Pack>& a) const {
    const int p = i + 2 * j + 4 * k;
    return {gram(times_transposed(a, cofactor_[p]), factor_[p]), dV0_[p]};
  }

 private:
  std::array<Mat3<Pack>, 8> cofactor_;
  PointValues<Pack> dV0_, factor_;  // factor: J^(-2/3) / dV0²
};

/// Floats kept per element and Gauss point by the cache: b and dV0.
constexpr int cached_floats = 7;

/// The strain of a pack's Gauss points, read from the cache (7 floats a point and lane).
struct CachedStrain {
  const float* data;
  PointStrain<Pack> at(int i, int j, int k, const Mat3<Pack>&) const {
    const float* p = data + (i + 2 * j + 4 * k) * cached_floats * lanes;
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
        q(r, c) = scale * (tau(r, 0) * cof(0, c) + tau(r, 1) * cof(1, c) + tau(r, 2) * cof(2, c)) + lambda * cof(r, c);
    flux.add(i, j, k, q);
  });
  return transposed_gradient(flux);
}

/// Action of a pack's tangent: forces K δx + b (δλ + γ W θ), where θ = bᵀ δx, b = ∂V_e/∂u, is returned too.
/// `penalty` is γ W = γ μ_e / V_e; `strain_of` gives the strain of the points from their det ∂x/∂ξ.
template <class P, class Material, class StrainOf>
NodalVectors<P> tangent_action(const Material& material, StrainOf strain_of, const ReferenceGradient<P>& x,
                                  const ReferenceGradient<P>& dx, const P& lambda, const P& dlambda,
                                  const P& penalty, P& theta) {
  struct Kinematics {
    Mat3<P> cof, l;
  };
  std::array<Kinematics, 8> points;
  PointValues<P> det, inverse;
  theta = 0;
  for_each_gauss_point([&](int i, int j, int k) {
    const int n = i + 2 * j + 4 * k;
    Kinematics& point = points[n];
    const Mat3<P> a = x.at(i, j, k);
    point.cof = cofactor(a);
    det[n] = determinant(a, point.cof);
    point.l = times_transposed(dx.at(i, j, k), point.cof);  // l det
    theta += trace(point.l);
  });
  for (int n = 0; n < 8; ++n) inverse[n] = 1.0 / det[n];
  const auto strain = strain_of(det);
  const P pressure = dlambda + penalty * theta;
  ReferenceGradient<P> flux{};
  for_each_gauss_point([&](int i, int j, int k) {
    const int n = i + 2 * j + 4 * k;
    const Kinematics& point = points[n];
    const PointStrain<P> s = strain.at(i, j, k, x.at(i, j, k));
    // T is linear in l: hand over l det and divide once. Everything carries one more 1/det for a⁻ᵀ = cof / det.
    const P dV0 = s.dV0 * inverse[n] * inverse[n];
    Mat3<P> t = material.tangent(s.b, point.l, dV0, P(lambda * inverse[n]));
    for (int r = 0; r < 3; ++r) t(r, r) += pressure;
    flux.add(i, j, k, t * point.cof);
  });
  return transposed_gradient(flux);
}

}  // namespace bulbus
