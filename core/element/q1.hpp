#pragma once
#include <array>

#include "core/base/tensor.hpp"

namespace bulbus {

/// Trilinear hexahedron with 2×2×2 Gauss points (weights 1), sum-factorised. Nodes and points are numbered i + 2j + 4k.
/// The derivative in one direction does not vary along it, so each has only four distinct values.

/// Position of node i + 2j + 4k in the order of Gmsh and VTK.
constexpr std::array<int, 8> vtk_of_lexicographic{0, 1, 3, 2, 4, 5, 7, 6};

constexpr double gauss_near = 0.788675134594812882254574390251;  ///< ½ (1 + 1/√3): weight of the nearer node
constexpr double gauss_far = 0.211324865405187117745425609749;   ///< ½ (1 − 1/√3)

template <class T>
using NodalVectors = std::array<Vec3<T>, 8>;

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
  void add(int i, int j, int k, const Mat3<T>& q) {
    for (int c = 0; c < 3; ++c) {
      along[0][c][j + 2 * k] += q(c, 0);
      along[1][c][i + 2 * k] += q(c, 1);
      along[2][c][i + 2 * j] += q(c, 2);
    }
  }
};

namespace q1 {

// The four values p + 2q, nodes to Gauss points; the matrix is symmetric, so it is its own transpose.
template <class T>
void interpolate(std::array<T, 4>& v) {
  const T a = gauss_near * v[0] + gauss_far * v[1], b = gauss_far * v[0] + gauss_near * v[1];
  const T c = gauss_near * v[2] + gauss_far * v[3], d = gauss_far * v[2] + gauss_near * v[3];
  v = {gauss_near * a + gauss_far * c, gauss_near * b + gauss_far * d, gauss_far * a + gauss_near * c,
       gauss_far * b + gauss_near * d};
}

constexpr std::array<int, 3> stride{1, 2, 4};
constexpr std::array<std::array<int, 2>, 3> others{{{2, 4}, {1, 4}, {1, 2}}};

}  // namespace q1

template <class T>
ReferenceGradient<T> reference_gradient(const NodalVectors<T>& v) {
  ReferenceGradient<T> g;
  for (int d = 0; d < 3; ++d)
    for (int c = 0; c < 3; ++c) {
      auto& along = g.along[d][c];
      for (int p = 0; p < 4; ++p) {
        const int n = (p & 1) * q1::others[d][0] + (p >> 1) * q1::others[d][1];
        along[p] = 0.5 * (v[n + q1::stride[d]][c] - v[n][c]);
      }
      q1::interpolate(along);
    }
  return g;
}

/// The transpose: Σ over points and directions of q · ∂N_n/∂ξ. `q` is used up.
template <class T>
NodalVectors<T> transposed_gradient(ReferenceGradient<T>& q) {
  NodalVectors<T> v;
  for (auto& node : v) node = {T(0.), T(0.), T(0.)};
  for (int d = 0; d < 3; ++d)
    for (int c = 0; c < 3; ++c) {
      auto& along = q.along[d][c];
      q1::interpolate(along);
      for (int p = 0; p < 4; ++p) {
        const int n = (p & 1) * q1::others[d][0] + (p >> 1) * q1::others[d][1];
        const T half = 0.5 * along[p];
        v[n][c] -= half;
        v[n + q1::stride[d]][c] += half;
      }
    }
  return v;
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

}  // namespace bulbus
