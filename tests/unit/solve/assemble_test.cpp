#include "core/solve/assemble.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/gathered.hpp"
#include "tests/support/models.hpp"

namespace bulbus {
namespace {

struct AssembleTest : testing::Test {
  Comm comm;
  Scene scene = filled_shell("octant");
  Problem problem{scene.mesh, scene.model, comm};
  State state = problem.initial_state();
  CoupledSystem system{problem, {.op = "recompute", .gamma = 10}};

  void SetUp() override {
    problem.begin_step(0, state), problem.set_progress(1, state), problem.end_step();
    state = shaken(problem, state, .02, 3);
    problem.begin_step(1, state);
    system.linearize(state, problem.residual(state));
  }
};

TEST_F(AssembleTest, GlobalSizeCountsNodesBodiesHexahedraAndLiquids) {
  EXPECT_EQ(global_size(system), 3 * problem.mesh().all_nodes + 6 + problem.mesh().all_hexes + 1);
}

TEST_F(AssembleTest, EveryRowHasADiagonalEntry) {
  const Triplets t = assemble(system, false);
  std::vector<double> has(global_size(system));
  for (std::size_t k = 0; k < t.row.size(); ++k) {
    ASSERT_GE(t.row[k], 0);
    ASSERT_LT(t.row[k], static_cast<int>(has.size()));
    if (t.row[k] == t.col[k]) has[t.row[k]] = 1;
  }
  comm.max(has);
  EXPECT_EQ(std::accumulate(has.begin(), has.end(), 0.0), static_cast<double>(has.size()));
}

TEST_F(AssembleTest, LiquidAddsTwiceItsWetUnknownsAndOne) {
  const Triplets t = assemble(system, false);
  const long long last = comm.size() == 1 ? global_size(system) - 1 : -1;
  if (last < 0) return;
  std::size_t in_row = 0, in_column = 0;
  for (std::size_t k = 0; k < t.row.size(); ++k) in_row += t.row[k] == last, in_column += t.col[k] == last;
  const std::size_t wet = std::ranges::count_if(system.liquid_columns()[0], [](double v) { return v != 0; });
  EXPECT_EQ(in_row, wet + 1);
  EXPECT_EQ(in_column, wet + 1);
}

TEST_F(AssembleTest, InertiaIsOneNegativePerHexahedronAndLiquid) {
  State still = problem.initial_state();  // stable and closed
  still.P = state.P;
  system.linearize(still, problem.residual(still));
  for (bool augmented : {false, true}) {
    const Eigen::MatrixXd A = gathered(assemble(system, augmented), global_size(system), comm);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(A, Eigen::EigenvaluesOnly);
    EXPECT_EQ((eigen.eigenvalues().array() < 0).count(), problem.mesh().all_hexes + 1);
  }
}

TEST_F(AssembleTest, MatrixIsTheSameHoweverManyRanks) {
  const Comm self(MPI_COMM_SELF);
  Problem alone(scene.mesh, scene.model, self);
  State whole = alone.initial_state();
  alone.begin_step(0, whole), alone.set_progress(1, whole), alone.end_step();
  whole = shaken(alone, whole, .02, 3);
  alone.begin_step(1, whole);
  CoupledSystem other(alone, {.op = "recompute", .gamma = 10});
  other.linearize(whole, alone.residual(whole));
  const double here = gathered(assemble(system, true), global_size(system), comm).norm();
  EXPECT_NEAR(here, gathered(assemble(other, true), global_size(other), self).norm(), 1e-11 * here);
}

TEST_F(AssembleTest, KindsFollowTheLayout) {
  const auto kinds = unknown_kinds({6, 6, 2, 1});
  ASSERT_EQ(kinds.size(), 15u);
  EXPECT_EQ(kinds[5], UnknownKind::displacement);
  EXPECT_EQ(kinds[6], UnknownKind::rigid);
  EXPECT_EQ(kinds[12], UnknownKind::element_pressure);
  EXPECT_EQ(kinds[14], UnknownKind::liquid_pressure);
}

}  // namespace
}  // namespace bulbus
