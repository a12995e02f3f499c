#include "core/solve/mumps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>

#include "core/base/error.hpp"
#include "core/solve/mumps_messages.hpp"
#include "tests/support/numbers.hpp"

namespace bulbus {
namespace {

/// Of the entries that all ranks build alike, every rank keeps the next one in turn.
struct Collector {
  const Comm& comm;
  Triplets mine = {};
  int next = 0;
  void add(int i, int j, double v) {
    if (next++ % comm.size() != comm.rank()) return;
    mine.row.push_back(i), mine.col.push_back(j), mine.value.push_back(v);
  }
  void add_both(int i, int j, double v) { add(i, j, v), add(j, i, v); }
};

/// Seven-point Laplacian on n³ nodes, an edge at a time, so that diagonal entries are sums.
void add_laplacian(Collector& c, int n, double shift = 0) {
  for (int i = 0; i < n * n * n; ++i)
    for (int stride : {1, n, n * n}) {
      c.add(i, i, 2 - shift / 3);
      if (i / stride % n < n - 1) c.add_both(i, i + stride, -1);
    }
}

/// This rank's rows out of n.
std::pair<int, int> share(int n, const Comm& comm) {
  return {static_cast<int>(1LL * n * comm.rank() / comm.size()),
          static_cast<int>(1LL * n * (comm.rank() + 1) / comm.size())};
}

/// Solves for a known solution; the largest error.
double error_of_solve(Mumps& mumps, const Triplets& t, int n, const Comm& comm) {
  std::vector<double> b(n, 0.0);
  for (std::size_t k = 0; k < t.row.size(); ++k) b[t.row[k]] += t.value[k] * std::sin(t.col[k] + 1);
  comm.sum(std::span<double>(b));
  auto [from, to] = share(n, comm);
  std::vector<double> x(to - from, NAN);
  if (!mumps.solve(std::span(b).subspan(from, to - from), x)) return INFINITY;
  double error = 0;
  for (int i = from; i < to; ++i)
    error = std::max(error, std::isfinite(x[i - from]) ? std::abs(x[i - from] - std::sin(i + 1)) : INFINITY);
  return comm.max(error);
}

struct MumpsTest : testing::Test {
  Comm comm;
  Collector c{comm};
};

TEST_F(MumpsTest, PositiveLaplacian) {
  add_laplacian(c, 12);
  Mumps mumps(comm);
  FactorReport r = mumps.factorise(c.mine, 1728, true);
  ASSERT_TRUE(r.ok) << r.reason;
  EXPECT_EQ(r.negative_pivots, 0);
  EXPECT_EQ(r.ordering, "Scotch");
  EXPECT_GT(r.factor_entries, 1728 * 4);
  EXPECT_GT(r.memory_mb, 0);
  EXPECT_GE(r.estimated_mb, r.estimated_max_mb);
  EXPECT_GT(r.flops, 1e6);
  EXPECT_LT(error_of_solve(mumps, c.mine, 1728, comm), 1e-11);
}

TEST_F(MumpsTest, SinglePrecisionTakesLessRoom) {
  const int n = 24 * 24 * 24;
  add_laplacian(c, 24);
  Mumps whole(comm), single(comm, {.precision = Precision::single});
  const FactorReport a = whole.factorise(c.mine, n, true), b = single.factorise(c.mine, n, true);
  ASSERT_TRUE(b.ok) << b.reason;
  EXPECT_LT(b.memory_mb, .75 * a.memory_mb);
  const double error = error_of_solve(single, c.mine, n, comm);
  EXPECT_LT(error, 1e-4);
  EXPECT_GT(error, 1e-9);
}

TEST_F(MumpsTest, InertiaOfAShiftedLaplacian) {
  const int n = 10;
  const double shift = 1.0;
  int negative = 0;  // eigenvalues Σ 2 - 2 cos(kπ/(n+1)) of the Laplacian below the shift
  auto eigenvalue = [&](int k) { return 2 - 2 * std::cos(k * M_PI / (n + 1)); };
  for (int i = 1; i <= n; ++i)
    for (int j = 1; j <= n; ++j)
      for (int k = 1; k <= n; ++k) negative += eigenvalue(i) + eigenvalue(j) + eigenvalue(k) < shift;
  ASSERT_GT(negative, 3);
  add_laplacian(c, n, shift);
  Mumps mumps(comm);
  EXPECT_EQ(mumps.factorise(c.mine, n * n * n, true).negative_pivots, negative);
}

TEST_F(MumpsTest, InertiaOfASaddle) {
  // [L Bᵀ; B 0] with L positive and B of full rank: as many negative eigenvalues as B has rows.
  const int n = 8, nodes = n * n * n, constraints = nodes / 4;
  add_laplacian(c, n);
  for (int e = 0; e < constraints; ++e)
    for (int a = 0; a < 4; ++a) c.add_both(nodes + e, 4 * e + a, a == 0 ? 2 : -0.5 * a);
  Mumps mumps(comm, {.refinements = 2});
  FactorReport r = mumps.factorise(c.mine, nodes + constraints, true);
  ASSERT_TRUE(r.ok) << r.reason;
  EXPECT_EQ(r.negative_pivots, constraints);
  EXPECT_LT(error_of_solve(mumps, c.mine, nodes + constraints, comm), 1e-11);
}

TEST_F(MumpsTest, Unsymmetric) {
  add_laplacian(c, 8);
  for (int i = 0; i + 1 < 512; ++i) c.add(i, i + 1, 0.3), c.add(i + 1, i, -0.4);
  Mumps mumps(comm);
  FactorReport r = mumps.factorise(c.mine, 512, false);
  ASSERT_TRUE(r.ok) << r.reason;
  EXPECT_LT(error_of_solve(mumps, c.mine, 512, comm), 1e-11);
}

TEST_F(MumpsTest, AnalysesAKnownPatternOnce) {
  add_laplacian(c, 8);
  Mumps mumps(comm);
  EXPECT_GT(mumps.factorise(c.mine, 512, true).seconds_analysis, 0);
  for (double& v : c.mine.value) v *= -3;
  FactorReport again = mumps.factorise(c.mine, 512, true);
  EXPECT_EQ(again.seconds_analysis, 0);
  EXPECT_EQ(again.negative_pivots, 512);
  EXPECT_LT(error_of_solve(mumps, c.mine, 512, comm), 1e-11);
  EXPECT_GT(mumps.factorise(c.mine, 512, false).seconds_analysis, 0);
  EXPECT_LT(error_of_solve(mumps, c.mine, 512, comm), 1e-11);
}

// 4 on the diagonal, −1 beside it and `far` two beyond, sorted; the first diagonal entry is `first`.
Triplets band_matrix(int n, double first, double far, const Comm& comm) {
  Triplets t;
  const auto [from, to] = share(n, comm);
  const auto add = [&](int i, int j, double v) {
    if (v != 0 && j >= 0 && j < n) t.row.push_back(i), t.col.push_back(j), t.value.push_back(v);
  };
  for (int i = from; i < to; ++i)
    add(i, i - 2, far), add(i, i - 1, -1), add(i, i, i == 0 ? first : 4), add(i, i + 1, -1),
        add(i, i + 2, far);
  return t;
}

TEST_F(MumpsTest, JoinsPatterns) {
  Mumps joined(comm, {.joined = true}), own(comm);
  const Triplets narrow = band_matrix(50, 4, 0, comm), wide = band_matrix(50, 4, -.01, comm);
  for (Mumps* mumps : {&joined, &own}) {
    EXPECT_GT(mumps->factorise(wide, 50, true).seconds_analysis, 0);
    EXPECT_EQ(mumps->factorise(narrow, 50, true).seconds_analysis == 0, false)
        << "two thirds more entries than it has";
  }
  Triplets holed = wide;
  const auto inside = std::ranges::find(holed.value, -.01) - holed.value.begin();
  for (auto* v : {&holed.row, &holed.col})
    if (comm.rank() == 0) v->erase(v->begin() + inside);
  if (comm.rank() == 0) holed.value.erase(holed.value.begin() + inside);
  for (Mumps* mumps : {&joined, &own}) {
    mumps->factorise(wide, 50, false);
    EXPECT_EQ(mumps->factorise(holed, 50, false).seconds_analysis == 0, mumps == &joined);
    EXPECT_LT(error_of_solve(*mumps, holed, 50, comm), 1e-13);
  }
}

TEST_F(MumpsTest, KeepsFactorsOfAMatrixThatHardlyDiffers) {
  Mumps mumps(comm);
  const Triplets old = band_matrix(50, 4, 0, comm);
  mumps.factorise(old, 50, true);
  const auto up_to = [](double most) { return [most](double change) { return change <= most; }; };
  EXPECT_FALSE(mumps.factorise(band_matrix(50, 4.2, 0, comm), 50, true).kept) << "nobody allowed it";
  EXPECT_TRUE(mumps.factorise(old, 50, true, up_to(.1)).kept);
  EXPECT_FALSE(mumps.factorise(old, 50, true, up_to(.01)).kept);
  for (double first : {4.2, 4.4, 4.49}) {  // a tenth of |4| + |−1|
    const FactorReport report = mumps.factorise(band_matrix(50, first, 0, comm), 50, true, up_to(.1));
    EXPECT_TRUE(report.ok);
    EXPECT_TRUE(report.kept) << first;
    EXPECT_LT(error_of_solve(mumps, old, 50, comm), 1e-13);
  }
  const Triplets far = band_matrix(50, 4.6, 0, comm);
  EXPECT_FALSE(mumps.factorise(far, 50, true, up_to(.1)).kept);
  EXPECT_LT(error_of_solve(mumps, far, 50, comm), 1e-13);
  const Triplets broken = band_matrix(50, NAN, 0, comm);
  EXPECT_FALSE(mumps.factorise(broken, 50, true, up_to(.1)).ok);
}

TEST_F(MumpsTest, SingularMatrixIsAValue) {
  for (int i = 0; i + 1 < 50; ++i)
    c.add(i, i, 1), c.add(i + 1, i + 1, 1), c.add_both(i, i + 1, -1);  // free chain
  Mumps mumps(comm);
  FactorReport r = mumps.factorise(c.mine, 50, true);
  EXPECT_FALSE(r.ok);
  EXPECT_EQ(r.reason, "the matrix is singular");
  auto [from, to] = share(50, comm);
  std::vector<double> b(to - from, 1.0), x(to - from, 7.0);
  EXPECT_FALSE(mumps.solve(b, x));
  EXPECT_EQ(x, std::vector<double>(to - from, 7.0));
}

// The pressures of two rows of cells between walls that do not move have checkerboard modes: zero rows of a
// saddle. Whatever the ordering, the solution is the one of least norm: no multiple of a mode is in it.
TEST_F(MumpsTest, SolutionOfASingularSystemIsThatOfLeastNorm) {
  const int n = 6, nodes = n * n * n, pairs = 20, rows = nodes + 2 * pairs;
  add_laplacian(c, n);
  for (int e = 0; e < 2 * pairs; ++e)  // each constraint twice
    for (int a = 0; a < 4; ++a) c.add_both(nodes + e, 4 * (e % pairs) + a, a == 0 ? 2 : -.7 * a);
  std::vector<double> b(rows, 0.);
  for (int i = 0; i < nodes; ++i) b[i] = std::sin(i + 1);
  const auto [from, to] = share(rows, comm);
  const auto mine = std::span(b).subspan(from, to - from);
  for (Ordering ordering : {Ordering::scotch, Ordering::metis, Ordering::amd}) {
    Mumps mumps(comm, {.ordering = ordering, .null_pivots = true});
    const FactorReport r = mumps.factorise(c.mine, rows, true);
    ASSERT_TRUE(r.ok) << r.reason;
    EXPECT_EQ(r.null_pivots, pairs);
    EXPECT_EQ(r.negative_pivots, pairs);
    EXPECT_EQ(r.nonpositive(), 2 * pairs);
    std::vector<double> x(mine.size());
    ASSERT_TRUE(mumps.solve(mine, x));
    const std::vector<double> all = comm.gather(std::span<const double>(x));
    for (int e = nodes; e < nodes + pairs; ++e) EXPECT_NEAR(all[e], all[e + pairs], 1e-12) << e;
    std::vector<double> Ax(rows, 0.);
    for (std::size_t k = 0; k < c.mine.row.size(); ++k)
      Ax[c.mine.row[k]] += c.mine.value[k] * all[c.mine.col[k]];
    comm.sum(std::span<double>(Ax));
    EXPECT_LT(relative_difference(Ax, b), 1e-12);
    EXPECT_FALSE(unsolvable(r, 1e-12));
    EXPECT_TRUE(unsolvable(r, 1e-3));
  }
}

TEST_F(MumpsTest, MatrixThatIsNotFinite) {
  add_laplacian(c, 4);
  if (comm.rank() == 0) c.mine.value[0] = std::numeric_limits<double>::quiet_NaN();
  Mumps mumps(comm);
  FactorReport r = mumps.factorise(c.mine, 64, true);
  EXPECT_FALSE(r.ok);
  EXPECT_EQ(r.reason, "the matrix is not finite");
}

TEST_F(MumpsTest, EstimatesAndRefusesWhatDoesNotFit) {
  add_laplacian(c, 12);
  Mumps mumps(comm, {.memory_limit_mb = 1});
  FactorReport estimate = mumps.analyse(c.mine, 1728, true);
  EXPECT_TRUE(estimate.ok);
  EXPECT_GT(estimate.estimated_mb, 1);
  EXPECT_GT(estimate.estimated_flops, 1e6);
  EXPECT_EQ(estimate.memory_mb, 0);
  FactorReport r = mumps.factorise(c.mine, 1728, true);
  EXPECT_FALSE(r.ok);
  EXPECT_NE(r.reason.find("MB allowed"), std::string::npos);
}

TEST_F(MumpsTest, RefusesWrongSizes) {
  Mumps mumps(comm);
  EXPECT_THROW(mumps.factorise(c.mine, 3000000000LL, true), InputError);
  c.add(5, 0, 1);
  EXPECT_THROW(mumps.factorise(c.mine, 5, true), std::invalid_argument);
}

// Buffers of messages are too small on several ranks alone.
TEST(MumpsMessages, ExplainWhatMoreWorkspaceMends) {
  for (int code : {-8, -9, -17, -20}) EXPECT_EQ(explain_mumps(code, 1), explain_mumps(-9, 1)) << code;
}

}  // namespace
}  // namespace bulbus
