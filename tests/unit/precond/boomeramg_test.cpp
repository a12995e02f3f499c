#include "precond/amg/boomeramg.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/solve/fgmres.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {
namespace {

/// Rows of this rank out of `total`, whole blocks of `unit`.
std::pair<long long, int> share(long long total, int unit, const Comm& comm) {
  long long blocks = total / unit, from = blocks * comm.rank() / comm.size(),
            to = blocks * (comm.rank() + 1) / comm.size();
  return {from * unit, static_cast<int>((to - from) * unit)};
}

/// 3-D seven-point Laplacian on n³ nodes; each of `functions` interleaved unknowns has its own copy.
DistributedCsr laplacian(int n, int functions, const Comm& comm) {
  DistributedCsr m;
  std::tie(m.first_row, m.rows) = share(1LL * n * n * n * functions, functions, comm);
  m.start = {0};
  auto put = [&](long long column, double value) { m.columns.push_back(column), m.values.push_back(value); };
  for (long long row = m.first_row; row < m.first_row + m.rows; ++row) {
    m.row_ids.push_back(row);
    put(row, 6);
    long long node = row / functions;
    for (long long stride : {1LL, 1LL * n, 1LL * n * n}) {
      long long i = node / stride % n;
      if (i > 0) put(row - stride * functions, -1);
      if (i < n - 1) put(row + stride * functions, -1);
    }
    m.start.push_back(static_cast<int>(m.columns.size()));
  }
  return m;
}

class Matrix : public LinearOperator {
 public:
  Matrix(const DistributedCsr& m, const Comm& comm) : m_(m), comm_(comm) {}
  int size() const override { return m_.rows; }
  void apply(std::span<const double> x, std::span<double> y) const override {
    std::vector<double> all = comm_.gather(x);
    for (int i = 0; i < m_.rows; ++i) {
      y[i] = 0;
      for (int k = m_.start[i]; k < m_.start[i + 1]; ++k) y[i] += m_.values[k] * all[m_.columns[k]];
    }
  }

 private:
  const DistributedCsr& m_;
  const Comm& comm_;
};

double dot(const std::vector<double>& a, const std::vector<double>& b, const Comm& comm) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return comm.sum(sum);
}

int iterations(const DistributedCsr& m, const BoomerAmg& amg, const Comm& comm) {
  std::vector<double> b(m.rows, 1.0), x(m.rows, 0.0);
  KrylovReport r = fgmres(Matrix(m, comm), &amg, b, x, {.tolerance = 1e-8}, comm);
  EXPECT_TRUE(r.converged) << r.reason;
  return r.iterations;
}

struct BoomerAmgTest : testing::Test {
  Comm comm;
};

TEST_F(BoomerAmgTest, IterationsDoNotGrowWithTheMesh) {
  for (int n : {8, 16, 32}) {
    DistributedCsr m = laplacian(n, 1, comm);
    BoomerAmg amg(m, {}, comm);
    ASSERT_EQ(amg.failure(), "");
    EXPECT_LE(iterations(m, amg, comm), n == 8 ? 8 : 11) << n;
    EXPECT_LE(amg.operator_complexity(), 4.0);
    EXPECT_LE(amg.grid_complexity(), 2.0);
    EXPECT_GE(amg.bytes(), m.values.size() * 12);
  }
}

TEST_F(BoomerAmgTest, EverySmootherGivesASymmetricPositiveLinearMap) {
  for (double shift : {0.0, 0.5}) {  // the second ends coarsening early
    DistributedCsr m = laplacian(10, 1, comm);
    for (int i = 0; i < m.rows; ++i) m.values[m.start[i]] += shift;
    for (AmgSmoother smoother : {AmgSmoother::gauss_seidel, AmgSmoother::symmetric_gauss_seidel,
                                 AmgSmoother::jacobi, AmgSmoother::chebyshev}) {
      BoomerAmg amg(m, {.smoother = smoother}, comm);
      auto x = noise_vector(m.rows, 1 + comm.rank()), y = noise_vector(m.rows, 100 + comm.rank());
      std::vector<double> Mx(m.rows, NAN), My(m.rows, NAN), sum(m.rows), Msum(m.rows);
      amg.apply(x, Mx);
      amg.apply(y, My);
      for (int i = 0; i < m.rows; ++i) sum[i] = x[i] + 2 * y[i];
      amg.apply(sum, Msum);
      double scale = dot(x, Mx, comm);
      EXPECT_GT(scale, 0);
      EXPECT_NEAR(dot(y, Mx, comm), dot(x, My, comm), 1e-12 * scale) << static_cast<int>(smoother);
      for (int i = 0; i < m.rows; ++i) EXPECT_NEAR(Msum[i], Mx[i] + 2 * My[i], 1e-12);
      EXPECT_LE(iterations(m, amg, comm), smoother == AmgSmoother::jacobi ? 22 : 11)
          << static_cast<int>(smoother);
    }
  }
}

TEST_F(BoomerAmgTest, AddsEntriesOfForeignRows) {
  DistributedCsr whole = laplacian(8, 1, comm), part = whole;
  // The last rank's first row arrives in equal parts from all ranks.
  long long foreign = share(512, 1, comm).first;
  foreign = static_cast<long long>(comm.max(static_cast<double>(foreign)));
  if (foreign >= part.first_row && foreign < part.first_row + part.rows) {
    int i = static_cast<int>(foreign - part.first_row);
    for (int k = part.start[i]; k < part.start[i + 1]; ++k) part.values[k] /= comm.size();
  }
  if (foreign < part.first_row || foreign >= part.first_row + part.rows) {
    part.row_ids.push_back(foreign);
    for (long long stride : {0, 1, -1, 8, -8, 64, -64}) {
      long long axis = std::max(1LL, std::abs(stride)), i = foreign / axis % 8;
      if ((stride > 0 && i == 7) || (stride < 0 && i == 0)) continue;
      part.columns.push_back(foreign + stride);
      part.values.push_back((stride == 0 ? 6.0 : -1.0) / comm.size());
    }
    part.start.push_back(static_cast<int>(part.columns.size()));
  }
  BoomerAmg a(whole, {}, comm), b(part, {}, comm);
  auto x = noise_vector(whole.rows, 7 + comm.rank());
  std::vector<double> ax(whole.rows), bx(whole.rows);
  a.apply(x, ax);
  b.apply(x, bx);
  for (int i = 0; i < whole.rows; ++i) EXPECT_NEAR(ax[i], bx[i], 1e-12);
}

TEST_F(BoomerAmgTest, SystemsByUnknownsAndByNodes) {
  DistributedCsr m = laplacian(8, 3, comm);
  BoomerAmg unknowns(m, {.functions = 3}, comm), nodal(m, {.functions = 3, .nodal = true}, comm);
  EXPECT_LE(iterations(m, unknowns, comm), 9);
  EXPECT_LE(iterations(m, nodal, comm), 12);
}

TEST_F(BoomerAmgTest, TakesRigidModes) {
  DistributedCsr m = laplacian(8, 3, comm);
  AmgOptions options{.functions = 3, .nodal = true};
  for (int a = 0; a < 3; ++a) {
    std::vector<double> mode(m.rows);
    for (int i = 0; i < m.rows; ++i) {
      long long node = (m.first_row + i) / 3, c = (m.first_row + i) % 3;
      double X[3] = {double(node % 8), double(node / 8 % 8), double(node / 64)};
      mode[i] = c == a ? 0 : (c == (a + 1) % 3 ? -X[(a + 2) % 3] : X[(a + 1) % 3]);  // e_a × X
    }
    options.rigid_modes.push_back(mode);
  }
  BoomerAmg amg(m, options, comm);
  ASSERT_EQ(amg.failure(), "");
  EXPECT_LE(iterations(m, amg, comm), 16);
}

TEST_F(BoomerAmgTest, IdentityRowsAreAllowed) {
  DistributedCsr m = laplacian(8, 1, comm);
  for (std::size_t i = 0; i < m.row_ids.size(); ++i)
    for (int k = m.start[i]; k < m.start[i + 1]; ++k)
      if (m.row_ids[i] % 8 == 0 || m.columns[k] % 8 == 0) m.values[k] = m.row_ids[i] == m.columns[k];
  BoomerAmg amg(m, {}, comm);
  EXPECT_LE(iterations(m, amg, comm), 10);
}

TEST_F(BoomerAmgTest, DiagonalMatrixIsSolvedExactly) {
  DistributedCsr m;
  std::tie(m.first_row, m.rows) = share(20000, 1, comm);
  m.start = {0};
  for (int i = 0; i < m.rows; ++i) {
    m.row_ids.push_back(m.first_row + i), m.columns.push_back(m.first_row + i), m.values.push_back(i + 1.0);
    m.start.push_back(i + 1);
  }
  BoomerAmg amg(m, {}, comm);
  ASSERT_EQ(amg.failure(), "");
  EXPECT_EQ(iterations(m, amg, comm), 1);
}

TEST_F(BoomerAmgTest, MatrixThatIsNotFinite) {
  DistributedCsr m = laplacian(8, 1, comm);
  if (comm.rank() == 0) m.values[0] = std::numeric_limits<double>::quiet_NaN();
  BoomerAmg amg(m, {}, comm);
  EXPECT_EQ(amg.failure(), "the matrix is not finite");
  std::vector<double> x(m.rows, 1.0), y(m.rows, 0.0);
  amg.apply(x, y);
  for (double v : y) EXPECT_TRUE(std::isnan(v));
}

TEST_F(BoomerAmgTest, VectorThatIsNotFiniteLeavesNoError) {
  DistributedCsr m = laplacian(8, 1, comm);
  BoomerAmg amg(m, {}, comm);
  std::vector<double> x(m.rows, std::numeric_limits<double>::quiet_NaN()), y(m.rows, 0.0);
  amg.apply(x, y);
  for (double v : y) EXPECT_TRUE(std::isnan(v));
  EXPECT_LE(iterations(m, amg, comm), 8);
}

TEST_F(BoomerAmgTest, RefusesTooManyUnknowns) {
  DistributedCsr m;
  m.start = {0};
  m.rows = comm.rank() == 0 ? std::numeric_limits<int>::max() : 2;
  m.first_row = comm.offset(m.rows);
  if (comm.size() == 1) GTEST_SKIP() << "one rank cannot hold as many";
  EXPECT_THROW(BoomerAmg(m, {}, comm), InputError);
}

TEST_F(BoomerAmgTest, RefusesSplitNodes) {
  DistributedCsr m = laplacian(4, 1, comm);
  EXPECT_THROW(BoomerAmg(m, {.functions = 1000}, comm), std::invalid_argument);
}

}  // namespace
}  // namespace bulbus
