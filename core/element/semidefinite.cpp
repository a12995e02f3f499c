#include "core/element/semidefinite.hpp"

#include <cmath>

namespace bulbus::inline element {
namespace {

constexpr int n = 9;
// Of the mean eigenvalue: beyond this below zero a smoother suffers. Usual states of tissue have eigenvalues
// around zero.
constexpr double clearly = 0.5;

template <class T>
using Matrix = std::array<std::array<T, n>, n>;

Matrix<Pack> without_pressure(const MeanTangent<Pack>& C, const PressureTangent& P) {
  Matrix<Pack> A;
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    Mat3<Pack> across = C.across[d];
    for (int k = 0; k < 3; ++k) {
      const int i = (k + 1) % 3, j = (k + 2) % 3;
      across(i, j) -= P[d][k];
      across(j, i) += P[d][k];
    }
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        A[3 * d + r][3 * d + c] = C.along[d](r, c);
        A[3 * e + r][3 * f + c] = A[3 * f + c][3 * e + r] = across(r, c);
      }
  }
  return A;
}

// By the signs of the pivots of A + clearly · mean · I.
std::array<bool, lanes> indefinite(Matrix<Pack> A) {
  Pack mean(0.);
  for (int i = 0; i < n; ++i) mean += (1. / n) * A[i][i];
  for (int i = 0; i < n; ++i) A[i][i] += clearly * mean;
  std::array<bool, lanes> found{};
  for (int k = 0; k < n; ++k) {
    for (int l = 0; l < lanes; ++l) found[l] |= A[k][k][l] < 0;
    const Pack inverse = 1.0 / A[k][k];
    for (int i = k + 1; i < n; ++i) {
      const Pack factor = A[k][i] * inverse;
      for (int j = i; j < n; ++j) A[i][j] -= factor * A[k][j];
    }
  }
  return found;
}

// Eigenvalues onto A's diagonal, eigenvectors into V's columns, by Jacobi's rotations.
void diagonalise(Matrix<double>& A, Matrix<double>& V) {
  constexpr int most_sweeps = 12;
  double trace = 0;
  for (int i = 0; i < n; ++i) trace += std::abs(A[i][i]);
  for (int sweep = 0; sweep < most_sweeps; ++sweep)
    for (int p = 0; p < n; ++p)
      for (int q = p + 1; q < n; ++q) {
        if (std::abs(A[p][q]) <= 1e-14 * trace) continue;
        const double theta = (A[q][q] - A[p][p]) / (2 * A[p][q]);
        const double t = std::copysign(1, theta) / (std::abs(theta) + std::hypot(theta, 1)),
                     c = 1 / std::hypot(t, 1), s = t * c;
        const auto rotate = [&](double& x, double& y) {
          const double before = x;
          x = c * before - s * y, y = s * before + c * y;
        };
        for (int k = 0; k < n; ++k) rotate(A[k][p], A[k][q]);
        for (int k = 0; k < n; ++k) rotate(A[p][k], A[q][k]);
        for (int k = 0; k < n; ++k) rotate(V[k][p], V[k][q]);
      }
}

// C += what lifts this lane's negative eigenvalues to zero.
void lift(const Matrix<Pack>& of_pack, int lane, MeanTangent<Pack>& C) {
  Matrix<double> A, V{};
  for (int i = 0; i < n; ++i) {
    V[i][i] = 1;
    for (int j = 0; j < n; ++j) A[i][j] = of_pack[i][j][lane];
  }
  diagonalise(A, V);
  for (int k = 0; k < n; ++k) {
    if (!(A[k][k] < 0)) continue;
    const auto part = [&](int i, int j) { return -A[k][k] * V[i][k] * V[j][k]; };
    for (int d = 0; d < 3; ++d) {
      const int e = (d + 1) % 3, f = (d + 2) % 3;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          if (r <= c) C.along[d](r, c).v[lane] += part(3 * d + r, 3 * d + c);
          C.across[d](r, c).v[lane] += part(3 * e + r, 3 * f + c);
        }
    }
  }
}

}  // namespace

void limit_to_semidefinite(MeanTangent<Pack>& C, const PressureTangent& P) {
  const Matrix<Pack> A = without_pressure(C, P);
  const auto found = indefinite(A);
  for (int l = 0; l < lanes; ++l)
    if (found[l]) lift(A, l, C);
}

}  // namespace bulbus::inline element
