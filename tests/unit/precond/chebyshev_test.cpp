#include "precond/smoothers/chebyshev.hpp"

#include <gtest/gtest.h>

namespace bulbus {
namespace {

struct Diagonal final : Preconditioner {
  std::vector<double> d;
  explicit Diagonal(std::vector<double> entries) : d(std::move(entries)) {}
  int size() const override { return static_cast<int>(d.size()); }
  bool is_linear() const override { return true; }
  void apply(std::span<const double> x, std::span<double> y) const override {
    for (std::size_t i = 0; i < d.size(); ++i) y[i] = d[i] * x[i];
  }
};

void expect_spectrum(const Diagonal& A, const Diagonal& D, double smallest, double largest) {
  const Spectrum s = lanczos(A, D, A.size(), Comm(MPI_COMM_SELF));
  EXPECT_NEAR(s.smallest, smallest, 1e-9);
  EXPECT_NEAR(s.largest, largest, 1e-9);
}

TEST(Lanczos, FindsTheSpectrumOfDefiniteMatrices) {
  expect_spectrum(Diagonal({1, 2, 3, 4, 5}), Diagonal({2, 1, 1, 1, 2}), 2, 10);
}

TEST(Lanczos, FindsTheSpectrumOfAnIndefiniteMatrix) {
  expect_spectrum(Diagonal({1, 2, 3, 4, -5}), Diagonal({1, 1, 1, 1, 2}), -10, 4);
}

TEST(Lanczos, FindsTheSpectrumUnderAnIndefinitePreconditioner) {
  expect_spectrum(Diagonal({1, 2, 3, 4, 5}), Diagonal({1, 1, 1, 1, -2}), -10, 4);
}

TEST(Chebyshev, TellsTheGrowthOfTheLargestEigenvalue) {
  const auto A = std::make_shared<Diagonal>(std::vector<double>{1, 2, 3, 4, 5});
  const auto D = std::make_shared<Diagonal>(std::vector<double>{1, 1, 1, 1, 1});
  const Comm comm(MPI_COMM_SELF);
  Chebyshev smoother(A, D, 4, .1, comm);
  A->d[4] = 5.5;
  EXPECT_NEAR(smoother.refresh(), 1.1, 1e-9);
  EXPECT_NEAR(smoother.largest_eigenvalue(), 1.1 * 5.5, 1e-9);
  A->d[2] = 500;
  EXPECT_NEAR(smoother.refresh(), 100, 1e-6);
}

}  // namespace
}  // namespace bulbus
