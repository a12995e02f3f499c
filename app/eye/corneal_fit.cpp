#include "app/eye/corneal_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/dense.hpp"
#include "core/mesh/geometry.hpp"

namespace bulbus::inline eye {
namespace {

constexpr int N = CornealSums::unknowns;

}  // namespace

// Unknowns 2c, k, a, 2b.
void CornealSums::add(const Vec3<double>& x) {
  const std::array<double, N> row{x[0], x[1], x[2], 1, x[0] * x[0] - x[1] * x[1], x[0] * x[1]};
  for (int i = 0; i < N; ++i) {
    for (int j = 0; j < N; ++j) v[N * i + j] += row[i] * row[j];
    v[N * N + i] += dot(x, x) * row[i];
  }
}

// Of F = 0 the curvatures are those of P ∇²F P / |∇F| with P = I − n nᵀ, n = ∇F / |∇F|.
CornealVertex fitted_cornea(const CornealSums& sums) {
  const auto u = solve_dense(std::span(sums.v).first<N * N>(), std::span(sums.v).last<N>());
  const double a = u[4], b = u[5] / 2;
  CornealVertex vertex;
  vertex.z = u[2] / 2 + std::sqrt(std::max(0., u[2] * u[2] / 4 + u[3]));
  const Vec3<double> gradient{-u[0], -u[1], 2 * vertex.z - u[2]};
  const double length = norm(gradient);
  const Vec3<double> n = 1 / length * gradient, across = Vec3<double>{1, 0, 0} - n[0] * n,
                     e1 = 1 / norm(across) * across, e2 = cross(n, e1);
  const auto second = [&](const Vec3<double>& d) {  // ∇²F d
    return Vec3<double>{(2 - 2 * a) * d[0] - 2 * b * d[1], -2 * b * d[0] + (2 + 2 * a) * d[1], 2 * d[2]};
  };
  const double mixed = dot(e1, second(e2)) / length;
  const SymmetricEigen curvatures =
      symmetric_eigen(std::array{dot(e1, second(e1)) / length, mixed, mixed, dot(e2, second(e2)) / length});
  vertex.flat = curvatures.values[0], vertex.steep = curvatures.values[1];
  const auto steepest = curvatures.vector(1);
  const Vec3<double> steep = steepest[0] * e1 + steepest[1] * e2;
  vertex.meridian = std::fmod(std::atan2(steep[1], steep[0]) + std::numbers::pi, std::numbers::pi);
  return vertex;
}

}  // namespace bulbus::inline eye
