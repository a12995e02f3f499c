#include "precond/coarse/block_hierarchy.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/solve/reduced.hpp"
#include "precond/coarse/aggregate_blocks.hpp"
#include "precond/coarse/aggregation.hpp"
#include "precond/coarse/rigid_coarse.hpp"
#include "tests/support/linearised.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

using Vector = Eigen::VectorXd;

/// The coarse matrix of small aggregates, as blocks.
struct Coarse : Linearised {
  RigidPlan plan;
  RigidModes modes;
  DistributedBlocks blocks;
  const BlockMatrix& A = blocks.A;
  explicit Coarse(const Scene& scene)
      : Linearised(scene, 0, .001),
        plan(*system, 8, Precision::single, 1000000),
        modes(rigid_modes(*system, plan.groups)),
        blocks(assembled()) {}

 private:
  DistributedBlocks assembled() {
    for_each_condensed_matrix(*system, Matrices::mean,
                              [&](std::span<const int> d, std::span<const double> K) {
                                plan.matrix.add(plan.groups, modes.of, d, K);
                              });
    for (const auto& e : system->body_extra())
      if (!problem.symmetric() || e.row <= e.column) plan.matrix.add(e.row, e.column, e.value);
    for (int k : modes.missing) plan.matrix.add(k, k, system->constrained_diagonal());
    return assemble_blocks(problem.comm(), plan.groups.total,
                           [&](const BlockVisitor& visit) { plan.matrix.visit(visit); });
  }
};

Eigen::MatrixXd dense(const BlockMatrix& A) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(6 * A.rows(), 6 * A.rows());
  for (int i = 0; i < A.rows(); ++i)
    for (int k = 0; const int j : A.columns(i)) {
      const auto block = A.block(i, k++);
      D.block<6, 6>(6 * i, 6 * j) =
          Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(block.data());
    }
  return D;
}

Vector of(const std::vector<double>& v) { return Eigen::Map<const Eigen::VectorXd>(v.data(), v.size()); }

TEST(BlockMatrix, IsThatOfItsTriplets) {
  for (const Scene& scene : {thin_plate(), filled_shell("octant")}) {
    const Coarse c(scene);
    Eigen::MatrixXd want = Eigen::MatrixXd::Zero(6 * c.A.rows(), 6 * c.A.rows());
    const Triplets t = c.plan.matrix.triplets();
    for (std::size_t e = 0; e < t.row.size(); ++e) {
      want(t.row[e], t.col[e]) += t.value[e];
      if (c.problem.symmetric() && t.row[e] != t.col[e]) want(t.col[e], t.row[e]) += t.value[e];
    }
    Eigen::MatrixXd error = dense(c.A) - want;
    EXPECT_LT(error.norm(), 1e-7 * want.norm());
    for (int i = 0; i < c.A.rows(); ++i)  // double precision
      EXPECT_LT((error.block<6, 6>(6 * i, 6 * i).norm()), 1e-13 * want.norm());
  }
}

TEST(BlockMatrix, MultipliesAndSweeps) {
  const Coarse c(thin_plate());
  const Eigen::MatrixXd D = dense(c.A);
  const std::size_t n = D.rows();
  const auto x = noise_vector(n, 1), b = noise_vector(n, 2);
  std::vector<double> y(n), z(n), step(n), rest(n);
  c.A.apply(x, y);
  EXPECT_LT((of(y) - D * of(x)).norm(), 1e-13 * of(y).norm());
  Vector want = Vector::Zero(static_cast<int>(n));
  const auto residual = [&] { return Vector(of(b) - D * want); };
  const auto relax = [&](std::size_t i) {
    want.segment<6>(i) += D.block<6, 6>(i, i).fullPivLu().solve(residual().segment<6>(i));
  };
  c.A.sweep_forwards(b, z, rest);
  c.A.subtract_upper(z, rest);
  for (std::size_t i = 0; i < n; i += 6) relax(i);
  EXPECT_LT((of(z) - want).norm(), 1e-10 * want.norm());
  EXPECT_LT((of(rest) - residual()).norm(), 1e-10 * of(b).norm());
  z = x, want = of(x);
  c.A.sweep_backwards(b, z, step, rest);
  c.A.subtract_lower(step, rest);
  for (std::size_t i = n; i > 0; i -= 6) relax(i - 6);
  EXPECT_LT((of(z) - want).norm(), 1e-10 * want.norm());
  EXPECT_LT((of(step) - (want - of(x))).norm(), 1e-10 * want.norm());
  EXPECT_LT((of(rest) - residual()).norm(), 1e-10 * (of(b).norm() + want.norm() * D.norm()));
}

TEST(AggregateBlocks, AreCompactAndKeepBodiesAsTheyAre) {
  const Coarse c(filled_shell("octant"));
  const auto group = aggregate_blocks(c.A, c.plan.groups.bodies, 5);
  ASSERT_EQ(c.plan.groups.bodies, 1);
  EXPECT_EQ(group[0], 0);
  EXPECT_EQ(std::ranges::count(group, 0), 1);
  const int groups = std::ranges::max(group) + 1;
  EXPECT_LE(groups, c.A.rows() / 3);
  for (int g = 1; g < groups; ++g) EXPECT_GT(std::ranges::count(group, g), 0);
}

// Rigid motions of the nodes, in modes of aggregates, in those of aggregates of aggregates and back.
TEST(CoarserModes, KeepRigidMotions) {
  Coarse c(small_eye(6));
  const auto group = aggregate_blocks(c.A, 0, 5);
  const CoarserModes m = coarser_modes(c.modes.frames, group, 0);
  const DofMap& dofs = c.problem.dofs();
  for (int mode = 0; mode < 6; ++mode) {
    std::vector<double> fine(6 * c.A.rows()), coarse(6 * m.frames.size()), back(fine.size());
    for (int n = 0; n < c.problem.mesh().owned; ++n) {
      if (c.plan.groups.of[n] < 0) continue;
      const Vec3<double> x = at(c.state.x, n),
                         axis{double(mode % 3 == 0), double(mode % 3 == 1), double(mode % 3 == 2)};
      const Vec3<double> u = mode < 3 ? axis : cross(axis, x);
      const Mat3<double> P = dofs.projector(n);
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 6; ++k)
          fine[6 * c.plan.groups.of[n] + k] +=
              c.modes.of[n][i][k] * (P(i, 0) * u[0] + P(i, 1) * u[1] + P(i, 2) * u[2]);
    }
    const auto each = [&](auto visit) {
      for (int i = 0; i < c.A.rows(); ++i)
        for (int r = 0; r < 6; ++r)
          for (int k = 0; k < 6; ++k) visit(6 * i + r, 6 * group[i] + k, m.weights[i][6 * r + k]);
    };
    each([&](int i, int k, double w) { coarse[k] += w * fine[i]; });
    each([&](int i, int k, double w) { back[i] += w * coarse[k]; });
    EXPECT_LT(relative_difference(back, fine), 1e-5) << mode;
  }
}

TEST(GalerkinProduct, IsThatOfTheModes) {
  for (const Scene& scene : {thin_plate(), filled_shell("octant")}) {
    const Coarse c(scene);
    const int bodies = c.plan.groups.bodies;
    const auto group = aggregate_blocks(c.A, bodies, 4);
    const CoarserModes m = coarser_modes(c.modes.frames, group, bodies);
    Eigen::MatrixXd W = Eigen::MatrixXd::Zero(6 * c.A.rows(), 6 * m.frames.size());
    for (int i = 0; i < c.A.rows(); ++i)
      W.block<6, 6>(6 * i, 6 * group[i]) =
          Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(m.weights[i].data());
    Eigen::MatrixXd want = W.transpose() * dense(c.A) * W;
    for (int k : m.missing) want(k, k) += 7;
    const Eigen::MatrixXd got = dense(galerkin_product(c.problem.comm(), c.blocks, group, m, 7).A);
    EXPECT_LT((got - want).norm(), 1e-5 * want.norm());
  }
}

/// What is left, in the energy of D, of an error that is noise.
double remaining_error(const Coarse& c, const Eigen::MatrixXd& D) {
  const auto plan = std::make_shared<HierarchyPlan>(Comm(MPI_COMM_SELF), 60);
  const BlockHierarchy M(c.blocks, c.modes.frames, c.plan.groups.bodies, c.system->constrained_diagonal(),
                         plan);
  EXPECT_EQ(M.setup_error(), "");
  EXPECT_GT(M.levels(), 1);
  const auto noise = noise_vector(D.rows(), 3);
  const Vector want = Eigen::Map<const Vector>(noise.data(), noise.size()), b = D * want;
  std::vector<double> got(noise.size(), std::nan(""));
  M.apply({b.data(), got.size()}, got);
  const Vector error = Eigen::Map<const Vector>(got.data(), got.size()) - want;
  return error.dot(D * error) / want.dot(D * want);
}

TEST(BlockHierarchy, IsNearlyTheInverse) {
  for (const Scene& scene : {thin_plate(), filled_shell("octant")}) {
    const Coarse c(scene);
    EXPECT_LT(std::abs(remaining_error(c, dense(c.A))), .05);
  }
}

// A matrix that is far from positive definite is told, and factorised in place of a cycle.
TEST(BlockHierarchy, LeavesWhatIsIndefiniteToAFactorisation) {
  Coarse c(small_eye(6));
  EXPECT_LT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense(c.A)).eigenvalues()[0], -.1);
  const auto plan = std::make_shared<HierarchyPlan>(Comm(MPI_COMM_SELF), 60);
  const BlockHierarchy M(c.blocks, c.modes.frames, 0, c.system->constrained_diagonal(), plan);
  EXPECT_FALSE(M.stable());
  const auto b = noise_primal(c.problem, 1);
  std::vector<double> levels(b.size()), factors(b.size());
  AggregationSettings settings;
  for (auto* x : {&levels, &factors}) {
    settings.factorised = x == &levels ? 100 : 1000000;
    const auto aggregation = std::make_shared<AggregationPlan>(*c.system, settings, Precision::single);
    EXPECT_EQ(aggregation->rigid->levels != nullptr, x == &levels);
    Aggregation(c.system, aggregation, settings).apply(b, *x);
  }
  EXPECT_LT(relative_difference(levels, factors), 1e-4);
}

// As many iterations with levels of aggregates as with factors, but for a few.
TEST(BlockHierarchy, TakesFewIterations) {
  for (const Scene& scene : {thin_plate(), small_eye(8)}) {
    const auto count = [&](int factorised) {
      return iterations(scene, 0, Displacement::aggregation, factorised);
    };
    EXPECT_LE(count(100), count(100000) + 2);
  }
}

}  // namespace
}  // namespace bulbus
