#include "core/base/dense.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace bulbus::inline base {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Eigen::Map<const RowMajor> square(std::span<const double> matrix) {
  const auto n = static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(matrix.size()))));
  return {matrix.data(), n, n};
}

}  // namespace

SymmetricEigen symmetric_eigen(std::span<const double> matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(square(matrix));
  const auto& values = eigen.eigenvalues();
  const auto& vectors = eigen.eigenvectors();  // stored by columns
  return {{values.begin(), values.end()}, {vectors.data(), vectors.data() + vectors.size()}};
}

std::vector<double> eigenvalues_real_parts(std::span<const double> matrix) {
  const Eigen::VectorXd values =
      Eigen::EigenSolver<Eigen::MatrixXd>(square(matrix), false).eigenvalues().real();
  return {values.begin(), values.end()};
}

std::vector<double> solve_dense(std::span<const double> matrix, std::span<const double> b) {
  const Eigen::VectorXd x = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(square(matrix))
                                .solve(Eigen::Map<const Eigen::VectorXd>(b.data(), std::ssize(b)));
  return {x.begin(), x.end()};
}

}  // namespace bulbus::inline base
