#pragma once
#include <array>

#include "core/base/tensor.hpp"

namespace bulbus::inline element {

/// Trilinear hexahedron with 2×2×2 Gauss points (weights 1), sum-factorised. Nodes and points are numbered i
/// + 2j + 4k. The derivative in one direction does not vary along it, so each has only four distinct values.
/// Fields go through their seven coefficients (modes), which costs a third less than interpolating in every
/// direction, and gives volumes in closed form.

/// Position of node i + 2j + 4k in the order of Gmsh and VTK.
constexpr std::array<int, 8> vtk_of_lexicographic{0, 1, 3, 2, 4, 5, 7, 6};

constexpr double gauss_near = 0.788675134594812882254574390251;  ///< ½ (1 + 1/√3): weight of the nearer node
constexpr double gauss_far = 0.211324865405187117745425609749;  ///< ½ (1 − 1/√3)
constexpr double gauss_point = gauss_near - gauss_far;          ///< 1/√3

template <class T>
using NodalVectors = std::array<Vec3<T>, 8>;

/// A trilinear vector field without its mean: Σ linear_d ξ_d + Σ twist_d ξ_e ξ_f + warp ξ₀ ξ₁ ξ₂ with e, f
/// the directions other than d. Or, dually, what a functional gives for each of these coefficients.
template <class T>
struct Modes {
  std::array<Vec3<T>, 3> linear, twist;
  Vec3<T> warp;
};

/// Reference derivatives of a vector field at the Gauss points: along[d][c][the two other indices].
template <class T>
struct ReferenceGradient {
  std::array<std::array<std::array<T, 4>, 3>, 3> along;

  /// ∂v_c/∂ξ_d at point (i, j, k).
  Mat3<T> at(int i, int j, int k) const {
    Mat3<T> g;
    for (int c = 0; c < 3; ++c) {
      g(c, 0) = along[0][c][j + 2 * k];
      g(c, 1) = along[1][c][i + 2 * k];
      g(c, 2) = along[2][c][i + 2 * j];
    }
    return g;
  }
  /// += t b
  void add_product(int i, int j, int k, const Mat3<T>& t, const Mat3<T>& b) {
    const std::array<int, 3> at{j + 2 * k, i + 2 * k, i + 2 * j};
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d) {
        T& q = along[d][c][at[d]];
        q = q + t(c, 0) * b(0, d) + t(c, 1) * b(1, d) + t(c, 2) * b(2, d);
      }
  }
  void add(int i, int j, int k, const Mat3<T>& q) {
    for (int c = 0; c < 3; ++c) {
      along[0][c][j + 2 * k] += q(c, 0);
      along[1][c][i + 2 * k] += q(c, 1);
      along[2][c][i + 2 * j] += q(c, 2);
    }
  }
};

/// Differences come before sums, so that a rigid translation leaves no rounding.
template <class T>
Modes<T> modes(const NodalVectors<T>& v) {
  Modes<T> m;
  for (int c = 0; c < 3; ++c) {
    const auto difference = [&](int a, int b) { return T(v[a][c] - v[b][c]); };
    const T a = difference(1, 0), b = difference(3, 2), d = difference(5, 4), e = difference(7, 6);
    const T lower = a + b, upper = d + e, lower_twist = b - a, upper_twist = e - d;
    const T lower_1 = difference(2, 0) + difference(3, 1), upper_1 = difference(6, 4) + difference(7, 5);
    m.linear[0][c] = 0.125 * (lower + upper);
    m.linear[1][c] = 0.125 * (lower_1 + upper_1);
    m.linear[2][c] = 0.125 * ((difference(4, 0) + difference(5, 1)) + (difference(6, 2) + difference(7, 3)));
    m.twist[2][c] = 0.125 * (lower_twist + upper_twist);
    m.twist[1][c] = 0.125 * (upper - lower);
    m.twist[0][c] = 0.125 * (upper_1 - lower_1);
    m.warp[c] = 0.125 * (upper_twist - lower_twist);
  }
  return m;
}

template <class T>
ReferenceGradient<T> reference_gradient(const Modes<T>& m) {
  ReferenceGradient<T> g;
  for (int d = 0; d < 3; ++d) {
    const int e = d == 0 ? 1 : 0, f = d == 2 ? 1 : 2;
    for (int c = 0; c < 3; ++c) {
      const T low = m.linear[d][c] - gauss_point * m.twist[f][c],
              high = m.linear[d][c] + gauss_point * m.twist[f][c];
      const T low_slope = m.twist[e][c] - gauss_point * m.warp[c],
              high_slope = m.twist[e][c] + gauss_point * m.warp[c];
      g.along[d][c] = {low - gauss_point * low_slope, high - gauss_point * high_slope,
                       low + gauss_point * low_slope, high + gauss_point * high_slope};
    }
  }
  return g;
}

template <class T>
ReferenceGradient<T> reference_gradient(const NodalVectors<T>& v) {
  return reference_gradient(modes(v));
}

/// Σ over points and directions of q · ∂/∂ξ: the transpose of the gradient of modes.
template <class T>
Modes<T> transposed_gradient(const ReferenceGradient<T>& q) {
  Modes<T> m;
  for (int c = 0; c < 3; ++c) {
    std::array<T, 3> twist{T(0.), T(0.), T(0.)};
    T warp(0.);
    for (int d = 0; d < 3; ++d) {
      const int e = d == 0 ? 1 : 0, f = d == 2 ? 1 : 2;
      const auto& along = q.along[d][c];
      const T low = along[0] + along[1], high = along[2] + along[3], low_twist = along[1] - along[0],
              high_twist = along[3] - along[2];
      m.linear[d][c] = low + high;
      twist[f] += low_twist + high_twist;
      twist[e] += high - low;
      warp += high_twist - low_twist;
    }
    for (int d = 0; d < 3; ++d) m.twist[d][c] = gauss_point * twist[d];
    m.warp[c] = gauss_point * gauss_point * warp;
  }
  return m;
}

/// The transpose of modes().
template <class T>
NodalVectors<T> nodal(const Modes<T>& m) {
  NodalVectors<T> v;
  for (int c = 0; c < 3; ++c) {
    const T lower = m.linear[0][c] - m.twist[1][c], upper = m.linear[0][c] + m.twist[1][c];
    const T lower_twist = m.twist[2][c] - m.warp[c], upper_twist = m.twist[2][c] + m.warp[c];
    const T sum = m.linear[1][c] + m.linear[2][c], difference = m.linear[1][c] - m.linear[2][c];
    const std::array<T, 4> even{m.twist[0][c] - sum, difference - m.twist[0][c],
                                T(-difference) - m.twist[0][c], m.twist[0][c] + sum};
    const std::array<T, 4> odd{lower - lower_twist, lower + lower_twist, upper - upper_twist,
                               upper + upper_twist};
    for (int n = 0; n < 4; ++n) {
      const T mean = 0.125 * even[n];
      v[2 * n][c] = mean - 0.125 * odd[n];
      v[2 * n + 1][c] = mean + 0.125 * odd[n];
    }
  }
  return v;
}

/// ∂V/∂(modes) from products of two coefficients: product(i, d, j, e) is that of number d of the coefficients
/// i and number e of j.
template <class T, class Product>
Modes<T> volume_gradient_of(Product product) {
  constexpr auto linear = &Modes<T>::linear, twist = &Modes<T>::twist;
  Modes<T> b;
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    const Vec3<T> area = product(linear, e, linear, f), bend = product(twist, e, twist, f);
    const Vec3<T> one = product(twist, f, linear, e), other = product(linear, f, twist, e);
    for (int c = 0; c < 3; ++c) {
      b.linear[d][c] = 8. * area[c] - (8. / 3) * bend[c];
      b.twist[d][c] = (8. / 3) * (one[c] + other[c]);
    }
  }
  b.warp = {T(0.), T(0.), T(0.)};
  return b;
}

/// b = ∂V/∂(modes) of the hexahedron with positions x, exact:
///     V = 8 [ l₀·(l₁×l₂) − ⅓ Σ l_d·(t_e×t_f) ],   (d, e, f) cyclic
template <class T>
Modes<T> volume_gradient(const Modes<T>& x) {
  return volume_gradient_of<T>([&](auto i, int d, auto j, int e) { return cross((x.*i)[d], (x.*j)[e]); });
}

/// Change of volume_gradient(x) with x, in the direction dx.
template <class T>
Modes<T> volume_gradient_change(const Modes<T>& x, const Modes<T>& dx) {
  return volume_gradient_of<T>([&](auto i, int d, auto j, int e) {
    const Vec3<T> p = cross((dx.*i)[d], (x.*j)[e]), q = cross((x.*i)[d], (dx.*j)[e]);
    return Vec3<T>{p[0] + q[0], p[1] + q[1], p[2] + q[2]};
  });
}

/// Σ of linear and twisting coefficients; a volume does not feel warping.
template <class T>
T volume_change(const Modes<T>& b, const Modes<T>& dx) {
  T sum(0.);
  for (int d = 0; d < 3; ++d)
    for (int c = 0; c < 3; ++c) sum = sum + b.linear[d][c] * dx.linear[d][c] + b.twist[d][c] * dx.twist[d][c];
  return sum;
}

template <class T>
void add_pressure(const Modes<T>& b, const T& p, Modes<T>& force) {
  for (int d = 0; d < 3; ++d)
    for (int c = 0; c < 3; ++c) {
      force.linear[d][c] += p * b.linear[d][c];
      force.twist[d][c] += p * b.twist[d][c];
    }
}

/// ∂N_n/∂ξ at point (i, j, k).
inline std::array<Vec3<double>, 8> reference_shape_gradient(int i, int j, int k) {
  const double at[3][2] = {{i ? gauss_far : gauss_near, i ? gauss_near : gauss_far},
                           {j ? gauss_far : gauss_near, j ? gauss_near : gauss_far},
                           {k ? gauss_far : gauss_near, k ? gauss_near : gauss_far}};
  std::array<Vec3<double>, 8> g;
  for (int n = 0; n < 8; ++n) {
    const int a = n & 1, b = (n >> 1) & 1, c = n >> 2;
    g[n] = {(a ? .5 : -.5) * at[1][b] * at[2][c], at[0][a] * (b ? .5 : -.5) * at[2][c],
            at[0][a] * at[1][b] * (c ? .5 : -.5)};
  }
  return g;
}

}  // namespace bulbus::inline element
