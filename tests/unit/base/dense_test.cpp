#include "core/base/dense.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace bulbus {
namespace {

TEST(Dense, EigenvectorsOfASymmetricMatrixBelongToTheirValues) {
  const std::array<double, 9> A{2, -1, 0, -1, 2, -1, 0, -1, 2};  // 2 − √2, 2, 2 + √2
  const SymmetricEigen eigen = symmetric_eigen(A);
  ASSERT_EQ(eigen.values.size(), 3U);
  EXPECT_NEAR(eigen.values[0], 2 - std::sqrt(2), 1e-14);
  EXPECT_NEAR(eigen.values[2], 2 + std::sqrt(2), 1e-14);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      double product = 0;
      for (int j = 0; j < 3; ++j) product += A[3 * i + j] * eigen.vector(k)[j];
      EXPECT_NEAR(product, eigen.values[k] * eigen.vector(k)[i], 1e-14);
    }
}

TEST(Dense, EigenvaluesOfAnyMatrix) {
  auto values = eigenvalues_real_parts(std::array<double, 4>{1, 2, 0, 3});  // triangular
  std::ranges::sort(values);
  EXPECT_NEAR(values[0], 1, 1e-14);
  EXPECT_NEAR(values[1], 3, 1e-14);
  for (double v : eigenvalues_real_parts(std::array<double, 4>{1, -2, 2, 1}))
    EXPECT_NEAR(v, 1, 1e-14);  // 1 ± 2i
}

TEST(Dense, SolvesRowByRow) {
  const auto x = solve_dense(std::array<double, 4>{1, 2, 0, 4}, std::array<double, 2>{5, 8});
  EXPECT_NEAR(x[0], 1, 1e-14);
  EXPECT_NEAR(x[1], 2, 1e-14);
}

}  // namespace
}  // namespace bulbus
