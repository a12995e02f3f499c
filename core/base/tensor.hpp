#pragma once
#include <array>
#include <cmath>
#include <span>

namespace bulbus {

/// 3×3 matrix over a scalar or a pack. Everything is unrolled by hand-sized loops; no temporaries on the
/// heap.
template <class T>
struct Mat3 {
  std::array<std::array<T, 3>, 3> m;
  T& operator()(int i, int j) { return m[i][j]; }
  const T& operator()(int i, int j) const { return m[i][j]; }
};

/// Symmetric 3×3 matrix, stored as xx, yy, zz, yz, xz, xy.
template <class T>
struct Sym3 {
  std::array<T, 6> v;
  static constexpr int index[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  T& operator()(int i, int j) { return v[index[i][j]]; }
  const T& operator()(int i, int j) const { return v[index[i][j]]; }
};

template <class T>
T trace(const Mat3<T>& a) {
  return a(0, 0) + a(1, 1) + a(2, 2);
}
template <class T>
T trace(const Sym3<T>& a) {
  return a.v[0] + a.v[1] + a.v[2];
}

/// Cofactor matrix: a⁻¹ = cof(a)ᵀ / det a.
template <class T>
Mat3<T> cofactor(const Mat3<T>& a) {
  Mat3<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      c(i, j) = a(i1, j1) * a(i2, j2) - a(i1, j2) * a(i2, j1);
    }
  return c;
}

/// det a, given its cofactors.
template <class T>
T determinant(const Mat3<T>& a, const Mat3<T>& cof) {
  return a(0, 0) * cof(0, 0) + a(0, 1) * cof(0, 1) + a(0, 2) * cof(0, 2);
}
template <class T>
T determinant(const Mat3<T>& a) {
  return determinant(a, cofactor(a));
}

template <class T>
Mat3<T> operator*(const Mat3<T>& a, const Mat3<T>& b) {
  Mat3<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return c;
}

/// a bᵀ
template <class T>
Mat3<T> times_transposed(const Mat3<T>& a, const Mat3<T>& b) {
  Mat3<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(j, 0) + a(i, 1) * b(j, 1) + a(i, 2) * b(j, 2);
  return c;
}

/// a b of a full and a symmetric matrix.
template <class T>
Mat3<T> operator*(const Mat3<T>& a, const Sym3<T>& b) {
  Mat3<T> c;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) c(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
  return c;
}

/// a : b
template <class T>
T contract(const Sym3<T>& a, const Mat3<T>& b) {
  return a.v[0] * b(0, 0) + a.v[1] * b(1, 1) + a.v[2] * b(2, 2) + a.v[3] * (b(1, 2) + b(2, 1)) +
         a.v[4] * (b(0, 2) + b(2, 0)) + a.v[5] * (b(0, 1) + b(1, 0));
}
template <class T>
T contract(const Sym3<T>& a, const Sym3<T>& b) {
  return a.v[0] * b.v[0] + a.v[1] * b.v[1] + a.v[2] * b.v[2] +
         2.0 * (a.v[3] * b.v[3] + a.v[4] * b.v[4] + a.v[5] * b.v[5]);
}

/// a aᵀ times a factor.
template <class T>
Sym3<T> gram(const Mat3<T>& a, const T& factor) {
  Sym3<T> s;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      s(i, j) = factor * (a(i, 0) * a(j, 0) + a(i, 1) * a(j, 1) + a(i, 2) * a(j, 2));
  return s;
}

/// a² of a symmetric matrix.
template <class T>
Sym3<T> square(const Sym3<T>& a) {
  Sym3<T> s;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) s(i, j) = a(i, 0) * a(0, j) + a(i, 1) * a(1, j) + a(i, 2) * a(2, j);
  return s;
}

template <class T>
using Vec3 = std::array<T, 3>;

template <class T>
Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <class T>
T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double norm(const Vec3<double>& a) { return std::sqrt(dot(a, a)); }
inline Vec3<double> minus(const Vec3<double>& a, const Vec3<double>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
/// The n-th of vectors that stand one after another, three numbers each: positions or displacements of nodes.
inline Vec3<double> at(std::span<const double> v, int n) { return {v[3 * n], v[3 * n + 1], v[3 * n + 2]}; }

}  // namespace bulbus
