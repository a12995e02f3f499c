#include "core/solve/fgmres.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bulbus {
namespace {

/// 2-D five-point Laplacian on n × n nodes; a rank owns whole lines and fetches its neighbours' by gathering
/// all.
class Laplacian : public LinearOperator {
 public:
  Laplacian(int n, const Comm& comm) : n_(n), comm_(comm) {
    int share = n / comm.size(), extra = n % comm.size();
    lines_ = share + (comm.rank() < extra);
    first_ = comm.rank() * share + std::min(comm.rank(), extra);
  }
  int size() const override { return n_ * lines_; }
  void apply(std::span<const double> x, std::span<double> y) const override {
    std::vector<double> all = comm_.gather(x);
    auto at = [&](int i, int j) { return i < 0 || j < 0 || i >= n_ || j >= n_ ? 0.0 : all[i * n_ + j]; };
    for (int i = first_; i < first_ + lines_; ++i)
      for (int j = 0; j < n_; ++j)
        y[(i - first_) * n_ + j] = 4 * at(i, j) - at(i - 1, j) - at(i + 1, j) - at(i, j - 1) - at(i, j + 1);
  }

 private:
  int n_, lines_, first_;
  const Comm& comm_;
};

class Scaling : public Preconditioner {
 public:
  Scaling(int size, double factor) : size_(size), factor_(factor) {}
  int size() const override { return size_; }
  bool is_linear() const override { return true; }
  void apply(std::span<const double> x, std::span<double> y) const override {
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = factor_ * x[i];
  }

 private:
  int size_;
  double factor_;
};

/// A few steps of GMRES: a different map at every call.
class InnerSolve : public Preconditioner {
 public:
  InnerSolve(const LinearOperator& A, const Comm& comm) : A_(A), comm_(comm) {}
  int size() const override { return A_.size(); }
  bool is_linear() const override { return false; }
  void apply(std::span<const double> x, std::span<double> y) const override {
    std::fill(y.begin(), y.end(), 0.0);
    fgmres(A_, nullptr, x, y, {.tolerance = 1e-1, .restart = 60, .max_iterations = 60}, comm_);
  }

 private:
  const LinearOperator& A_;
  const Comm& comm_;
};

class Broken : public Scaling {
 public:
  Broken(int size, int good, double bad) : Scaling(size, 2), left_(good), bad_(bad) {}
  void apply(std::span<const double> x, std::span<double> y) const override {
    for (std::size_t i = 0; i < x.size(); ++i) y[i] = (i + 1) * x[i];
    if (left_-- <= 0 && !y.empty()) y[0] = bad_;
  }

 private:
  mutable int left_;
  double bad_;
};

double true_residual(const LinearOperator& A, std::span<const double> b, std::span<const double> x,
                     const Comm& comm) {
  std::vector<double> r(b.size());
  A.apply(x, r);
  double sum = 0;
  for (std::size_t i = 0; i < b.size(); ++i) sum += (b[i] - r[i]) * (b[i] - r[i]);
  return std::sqrt(comm.sum(sum));
}

struct Fgmres : testing::Test {
  Comm comm;
  Laplacian A{24, comm};
  std::vector<double> b = std::vector<double>(A.size(), 1.0), x = std::vector<double>(A.size(), 0.0);
};

TEST_F(Fgmres, SolvesTheLaplacian) {
  KrylovReport r = fgmres(A, nullptr, b, x, {.tolerance = 1e-8, .restart = 100}, comm);
  EXPECT_TRUE(r.converged) << r.reason;
  EXPECT_DOUBLE_EQ(r.initial, 24);
  EXPECT_NEAR(r.final, true_residual(A, b, x, comm), 1e-12);
  EXPECT_LE(r.final, 1.1e-8 * 24);
  EXPECT_EQ(r.iterations, 44);
  ASSERT_EQ(r.history.size(), 45u);
  EXPECT_NEAR(r.history[0], 24, 1e-10);
  EXPECT_NEAR(r.history.back(), r.final, 1e-9);
}

TEST_F(Fgmres, FixedPreconditionerGivesTheSameInBothVariants) {
  Scaling M(A.size(), 0.25);
  std::vector<double> y = x;
  KrylovReport flexible = fgmres(A, &M, b, x, {.tolerance = 1e-8, .restart = 25}, comm);
  KrylovReport plain = fgmres(A, &M, b, y, {.tolerance = 1e-8, .restart = 25, .flexible = false}, comm);
  EXPECT_TRUE(flexible.converged && plain.converged);
  EXPECT_EQ(flexible.iterations, plain.iterations);
  const std::size_t vector = b.size() * sizeof(double), others = 6;  // residuals and updates
  EXPECT_GE(flexible.basis_bytes, 2 * 25 * vector);
  EXPECT_LE(flexible.basis_bytes, (2 * 26 + others) * vector);
  EXPECT_GE(plain.basis_bytes, 25 * vector);
  EXPECT_LE(plain.basis_bytes, (26 + others) * vector);
  EXPECT_EQ(static_cast<int>(flexible.history.size()), flexible.iterations + 1);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], y[i], 1e-4);
}

TEST_F(Fgmres, BasisInSinglePrecisionCostsHalfAndNoIterations) {
  Scaling M(A.size(), 0.25);
  std::vector<double> y = x;
  KrylovOptions options{.tolerance = 1e-5, .restart = 60, .flexible = false};
  const KrylovReport full = fgmres(A, &M, b, x, options, comm);
  options.basis = Precision::single;
  const KrylovReport single = fgmres(A, &M, b, y, options, comm);
  EXPECT_TRUE(full.converged && single.converged) << single.reason;
  EXPECT_EQ(single.iterations, full.iterations);
  EXPECT_LE(single.basis_bytes, .65 * full.basis_bytes);
  EXPECT_LE(single.final, 1.1e-5 * single.initial);
}

TEST_F(Fgmres, ColumnsThatAreNotReachedCostNothing) {
  Scaling M(A.size(), 0.25);
  const KrylovReport loose = fgmres(A, &M, b, x, {.tolerance = .3, .restart = 100, .flexible = false}, comm);
  EXPECT_TRUE(loose.converged);
  EXPECT_LE(loose.basis_bytes, (loose.iterations + 8) * b.size() * sizeof(double));
}

TEST_F(Fgmres, TakesAVariablePreconditioner) {
  InnerSolve M(A, comm);
  KrylovReport r = fgmres(A, &M, b, x, {.tolerance = 1e-8}, comm);
  EXPECT_TRUE(r.converged) << r.reason;
  EXPECT_LE(r.iterations, 9);
  EXPECT_LE(true_residual(A, b, x, comm), 1.1e-8 * 24);
}

TEST_F(Fgmres, StartsFromTheGuess) {
  fgmres(A, nullptr, b, x, {.tolerance = 1e-10, .restart = 100}, comm);
  std::vector<double> before = x;
  KrylovReport again = fgmres(A, nullptr, b, x, {.tolerance = 1e-6}, comm);
  EXPECT_TRUE(again.converged);
  EXPECT_EQ(again.iterations, 0);
  EXPECT_EQ(x, before);
}

TEST_F(Fgmres, ZeroRightHandSide) {
  std::fill(b.begin(), b.end(), 0.0);
  std::fill(x.begin(), x.end(), 3.0);
  KrylovReport r = fgmres(A, nullptr, b, x, {}, comm);
  EXPECT_TRUE(r.converged);
  EXPECT_EQ(r.iterations, 0);
  for (double v : x) EXPECT_EQ(v, 0);
}

TEST_F(Fgmres, ReportsExhaustedIterations) {
  Scaling M(A.size(), 0.25);
  KrylovReport r = fgmres(A, &M, b, x, {.tolerance = 1e-12, .restart = 5, .max_iterations = 12}, comm);
  EXPECT_FALSE(r.converged);
  EXPECT_EQ(r.iterations, 12);
  EXPECT_EQ(r.reason, "iterations exhausted");
  EXPECT_LT(r.final, r.initial);
  EXPECT_NEAR(r.final, true_residual(A, b, x, comm), 1e-12);
}

TEST_F(Fgmres, BreakdownIsAValue) {
  for (double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (int good : {0, 4}) {
      std::vector<double> y(A.size(), 1.0);
      Broken B(A.size(), good, bad);
      KrylovReport r = fgmres(B, nullptr, b, y, {.tolerance = 1e-12, .max_iterations = 30}, comm);
      EXPECT_FALSE(r.converged);
      EXPECT_FALSE(r.reason.empty());
      EXPECT_EQ(std::isfinite(r.final), good > 0);  // else not even the guess has a residual
      for (double v : y) EXPECT_TRUE(std::isfinite(v));
      std::vector<double> zero(A.size(), 0.0);  // its residual is b
      EXPECT_TRUE(std::isfinite(fgmres(Broken(A.size(), good, bad), nullptr, b, zero,
                                       {.tolerance = 1e-12, .max_iterations = 30}, comm)
                                    .final));
      for (double v : zero) EXPECT_TRUE(std::isfinite(v));
    }
}

TEST_F(Fgmres, SingularSystemEndsWithoutException) {
  Scaling zero(A.size(), 0.0);
  KrylovReport r = fgmres(zero, nullptr, b, x, {.max_iterations = 20}, comm);
  EXPECT_FALSE(r.converged);
  for (double v : x) EXPECT_TRUE(std::isfinite(v));
}

TEST_F(Fgmres, LargerBasisThanUnknowns) {
  Broken diagonal(comm.rank() == 0 ? 3 : 0, 1000, 0);  // diag(1, 2, 3), all on the first rank
  std::vector<double> c(diagonal.size(), 1.0), y(diagonal.size(), 0.0);
  KrylovReport r = fgmres(diagonal, nullptr, c, y, {.tolerance = 1e-12, .restart = 40}, comm);
  EXPECT_TRUE(r.converged) << r.reason;
  EXPECT_EQ(r.iterations, 3);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], 1.0 / (i + 1), 1e-12);
}

TEST_F(Fgmres, ObserverSeesTheIterates) {
  Scaling M(A.size(), 0.25);
  for (bool flexible : {true, false}) {
    std::vector<double> y(A.size(), 0.0), seen;
    KrylovReport r = fgmres(A, &M, b, y, {.tolerance = 1e-6, .restart = 20, .flexible = flexible}, comm,
                            [&](int k, std::span<const double> at) {
                              EXPECT_EQ(k, static_cast<int>(seen.size()));
                              seen.push_back(true_residual(A, b, at, comm));
                            });
    ASSERT_EQ(seen.size(), r.history.size());
    for (std::size_t k = 0; k < seen.size(); ++k) EXPECT_NEAR(seen[k], r.history[k], 1e-9 * r.initial);
  }
}

}  // namespace
}  // namespace bulbus
