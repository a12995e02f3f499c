#pragma once
#include <Eigen/Dense>

#include "core/base/parallel.hpp"
#include "core/solve/triplets.hpp"

namespace bulbus {

/// The whole matrix on every rank. Collective.
inline Eigen::MatrixXd gathered(const Triplets& t, long long size, const Comm& comm) {
  const std::vector<long long> row(t.row.begin(), t.row.end()), col(t.col.begin(), t.col.end());
  const auto rows = comm.gather(std::span<const long long>(row)),
             cols = comm.gather(std::span<const long long>(col));
  const auto values = comm.gather(std::span<const double>(t.value));
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t k = 0; k < rows.size(); ++k) A(rows[k], cols[k]) += values[k];
  return A;
}

/// A distributed vector, whole on every rank. Collective.
inline Eigen::VectorXd gathered(std::span<const double> v, const Comm& comm) {
  const auto all = comm.gather(v);
  return Eigen::Map<const Eigen::VectorXd>(all.data(), static_cast<long>(all.size()));
}

}  // namespace bulbus
