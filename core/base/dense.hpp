#pragma once
#include <span>
#include <vector>

namespace bulbus::inline base {

/// Small dense matrices, given row by row (n × n numbers). Their decompositions are Eigen's, compiled once.
struct SymmetricEigen {
  std::vector<double> values;   ///< ascending
  std::vector<double> vectors;  ///< the k-th, of length 1, from k n on
  std::span<const double> vector(std::size_t k) const {
    return std::span(vectors).subspan(k * values.size(), values.size());
  }
};
SymmetricEigen symmetric_eigen(std::span<const double> matrix);

/// Of any square matrix, unordered.
std::vector<double> eigenvalues_real_parts(std::span<const double> matrix);

/// x of A x = b, in the sense of least squares where A is singular (QR with column pivoting).
std::vector<double> solve_dense(std::span<const double> matrix, std::span<const double> b);

}  // namespace bulbus::inline base
