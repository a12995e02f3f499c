#include "app/eye/corneal_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace bulbus::inline eye {
namespace {

constexpr int N = CornealSums::unknowns;
using Normal = Eigen::Matrix<double, N, N, Eigen::RowMajor>;
using Column = Eigen::Matrix<double, N, 1>;

}  // namespace

// Unknowns 2c, k, a, 2b.
void CornealSums::add(const Vec3<double>& x) {
  const Column row{x[0], x[1], x[2], 1, x[0] * x[0] - x[1] * x[1], x[0] * x[1]};
  Eigen::Map<Normal>(v.data()) += row * row.transpose();
  Eigen::Map<Column>(v.data() + N * N) += dot(x, x) * row;
}

// Of F = 0 the curvatures are those of P ∇²F P / |∇F| with P = I − n nᵀ, n = ∇F / |∇F|.
CornealVertex fitted_cornea(const CornealSums& sums) {
  const Column u = Eigen::Map<const Normal>(sums.v.data())
                       .colPivHouseholderQr()
                       .solve(Eigen::Map<const Column>(sums.v.data() + N * N));
  const double a = u[4], b = u[5] / 2;
  CornealVertex vertex;
  vertex.z = u[2] / 2 + std::sqrt(std::max(0., u[2] * u[2] / 4 + u[3]));
  const Eigen::Vector3d gradient(-u[0], -u[1], 2 * vertex.z - u[2]);
  Eigen::Matrix3d H;
  H << 2 - 2 * a, -2 * b, 0, -2 * b, 2 + 2 * a, 0, 0, 0, 2;
  const Eigen::Vector3d n = gradient.normalized(), e1 = (Eigen::Vector3d::UnitX() - n[0] * n).normalized(),
                        e2 = n.cross(e1);
  Eigen::Matrix<double, 3, 2> across;
  across << e1, e2;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> curvatures(across.transpose() * H * across /
                                                                  gradient.norm());
  vertex.flat = curvatures.eigenvalues()[0], vertex.steep = curvatures.eigenvalues()[1];
  const Eigen::Vector3d steep = across * curvatures.eigenvectors().col(1);
  vertex.meridian = std::fmod(std::atan2(steep[1], steep[0]) + std::numbers::pi, std::numbers::pi);
  return vertex;
}

}  // namespace bulbus::inline eye
