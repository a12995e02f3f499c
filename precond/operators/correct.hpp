#pragma once
#include <vector>

#include "core/solve/linear_operator.hpp"

namespace bulbus::inline precond {

/// x += M (b − A x). `residual` and `correction` are workspace of A's size. Collective.
inline void correct(const LinearOperator& A, const Preconditioner& M, std::span<const double> b,
                    std::span<double> x, std::span<double> residual, std::span<double> correction) {
  A.apply(x, residual);
  for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = b[i] - residual[i];
  M.apply(residual, correction);
  for (std::size_t i = 0; i < residual.size(); ++i) x[i] += correction[i];
}

}  // namespace bulbus::inline precond
