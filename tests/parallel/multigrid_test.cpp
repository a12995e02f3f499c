// One cycle is the same map however many ranks, but for the lines and aggregates that their boundaries cut.
#include <gtest/gtest.h>

#include "precond/make_preconditioner.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

struct Solved {
  std::vector<double> dx;  // by the Mesh's nodes
  int iterations = 0;
};

// The first linear system of a scene on its mesh, refined so many times.
Solved solve(const Scene& scene, int refine, const Comm& comm) {
  Problem problem(refined(scene.mesh, refine), scene.model, comm);
  State state = problem.initial_state();
  problem.begin_step(0, state);
  problem.set_progress(.5, state);
  LinearSettings settings;
  settings.aggregation.factorised = 100;
  const Residual r = problem.residual(state);
  const auto system = std::make_shared<const CoupledSystem>(problem, settings, state, r);
  Profiler profiler;
  auto solver = make_krylov_solver(settings, make_preconditioner_factory(settings, profiler), profiler);
  const Preparation prepared = solver->prepare(system);
  EXPECT_TRUE(prepared.ok);
  const CoupledOperator A(system, prepared.augmentation);
  std::vector<double> prescribed(state.x.size()), x(system->size()), dx(state.x.size());
  problem.dofs().prescribed_increment(state, .5, prescribed);
  const LinearReport report = solver->solve(A, A.right_hand_side(r, prescribed), x, 1e-8);
  EXPECT_TRUE(report.ok) << report.reason;
  problem.dofs().expand(state, system->layout().primal(std::span<const double>(x)), dx);
  const LocalMesh& mesh = problem.mesh();
  Solved s{std::vector<double>(3 * mesh.all_nodes), report.iterations};
  for (int n = 0; n < mesh.owned; ++n)
    for (int c = 0; c < 3; ++c) s.dx[3 * mesh.input_node[n] + c] = dx[3 * n + c];
  comm.sum(s.dx);
  return s;
}

void expect_same(const Scene& scene, int refine = 1) {
  const Solved alone = solve(scene, refine, Comm(MPI_COMM_SELF)), together = solve(scene, refine, Comm());
  double size = 0, difference = 0;
  for (std::size_t i = 0; i < alone.dx.size(); ++i) {
    size = std::max(size, std::abs(alone.dx[i]));
    difference = worse(difference, std::abs(alone.dx[i] - together.dx[i]));
  }
  EXPECT_LT(difference, 1e-5 * size);
  EXPECT_LE(together.iterations, alone.iterations * 1.25 + 2);
  std::printf("%d iterations alone, %d on %d ranks\n", alone.iterations, together.iterations, Comm().size());
}

TEST(Multigrid, OnAnyNumberOfRanksSolvesABlock) { expect_same(stretched_block(4, ".1")); }

TEST(Multigrid, OnAnyNumberOfRanksSolvesAShellWithARigidCapAndBars) { expect_same(filled_shell("half")); }

TEST(Multigrid, OnAnyNumberOfRanksSolvesTheHalfEye) { expect_same(small_eye(8)); }

TEST(Aggregation, OnAnyNumberOfRanksSolvesABlockByLevels) { expect_same(stretched_block(8, ".1"), 0); }

TEST(Aggregation, OnAnyNumberOfRanksSolvesAShellWithARigidCapAndBarsByLevels) {
  expect_same(filled_shell("half"), 0);
}

}  // namespace
}  // namespace bulbus
