#include "core/solve/assemble.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "tests/support/gathered.hpp"
#include "tests/support/models.hpp"

namespace bulbus {
namespace {

struct AssembleTest : testing::Test {
  Comm comm;
  Scene scene = filled_shell("octant");
  Problem problem{scene.mesh, scene.model, comm};
  State state = problem.initial_state();
  SharedSystem system;

  void SetUp() override {
    problem.begin_step(0, state), problem.set_progress(1, state), problem.end_step();
    state = shaken(problem, state, .02, 3);
    problem.begin_step(1, state);
    linearise(state);
  }
  void linearise(const State& at) {
    system = std::make_shared<const CoupledSystem>(
        problem, LinearSettings{.op = TangentStorage::recompute, .gamma = 10}, at, problem.residual(at));
  }
};

TEST_F(AssembleTest, GlobalSizeCountsNodesBodiesHexahedraAndLiquids) {
  EXPECT_EQ(global_size(system->problem()), 3 * problem.mesh().all_nodes + 6 + problem.mesh().all_hexes + 1);
}

TEST_F(AssembleTest, EveryRowHasADiagonalEntry) {
  const Triplets t = assemble_plain(*system);
  std::vector<double> has(global_size(system->problem()));
  for (std::size_t k = 0; k < t.row.size(); ++k) {
    ASSERT_GE(t.row[k], 0);
    ASSERT_LT(t.row[k], static_cast<int>(has.size()));
    if (t.row[k] == t.col[k]) has[t.row[k]] = 1;
  }
  comm.max(has);
  EXPECT_EQ(std::accumulate(has.begin(), has.end(), 0.0), static_cast<double>(has.size()));
}

TEST_F(AssembleTest, LiquidAddsTwiceItsWetUnknownsAndOne) {
  const Triplets t = assemble_plain(*system);
  const long long last = comm.size() == 1 ? global_size(system->problem()) - 1 : -1;
  if (last < 0) return;
  std::size_t in_row = 0, in_column = 0;
  for (std::size_t k = 0; k < t.row.size(); ++k) in_row += t.row[k] == last, in_column += t.col[k] == last;
  const std::size_t wet = std::ranges::count_if(system->liquid_columns()[0], [](double v) { return v != 0; });
  EXPECT_EQ(in_row, wet + 1);
  EXPECT_EQ(in_column, wet + 1);
}

TEST_F(AssembleTest, InertiaIsOneNegativePerHexahedronAndLiquid) {
  State still = problem.initial_state();  // stable and closed
  still.P = state.P;
  linearise(still);
  for (bool augmented : {false, true}) {
    const Eigen::MatrixXd A =
        gathered(augmented ? assemble(CoupledOperator(system)) : assemble_plain(*system),
                 global_size(system->problem()), comm);
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
  const auto other = std::make_shared<const CoupledSystem>(
      alone, LinearSettings{.op = TangentStorage::recompute, .gamma = 10}, whole, alone.residual(whole));
  const double here =
      gathered(assemble(CoupledOperator(system)), global_size(system->problem()), comm).norm();
  EXPECT_NEAR(here, gathered(assemble(CoupledOperator(other)), global_size(alone), self).norm(),
              1e-11 * here);
}

/// The matrix of a liquid-filled shell of n cells across an octant, by one formulation.
struct Counted {
  long long wet_nodes = 0, wet = 0;  ///< k, and its displacements that symmetry leaves free
  long long entries = 0, among_wet = 0, bounds = 0, dry_entries = 0;

  Counted(int n, Formulation formulation) {
    const Comm self(MPI_COMM_SELF);
    Scene scene{generate(ShellShape{.inner = 2, .outer = 2.4, .n = n, .layers = 1}), {}};
    scene.model.regions["shell"] = neo_hooke(.5);
    scene.model.liquids["fluid"] = {.surface = "inner", .K = 3};
    scene.model.symmetry = {"x", "y", "z"};
    scene.model.steps = {step("given"), step("enclosed")};
    scene.model.steps[0].pressures["fluid"] = "0.01";
    scene.model.steps[1].enclose = {"fluid"};
    Problem problem(scene.mesh, scene.model, self);
    State state = problem.initial_state();
    SharedSystem system;
    const auto linearise = [&] {
      const LinearSettings settings{.formulation = formulation, .op = TangentStorage::recompute, .gamma = 0};
      system = std::make_shared<const CoupledSystem>(problem, settings, state, problem.residual(state));
    };
    problem.begin_step(0, state), problem.set_progress(1, state);
    linearise();
    dry_entries = static_cast<long long>(assemble(CoupledOperator(system)).row.size());
    problem.end_step();
    problem.begin_step(1, state), problem.set_progress(1, state);
    linearise();
    const auto& g = system->liquid_columns()[0];
    const Triplets t = assemble(CoupledOperator(system));
    entries = static_cast<long long>(t.row.size());
    const auto is_wet = [&](int i) { return i < static_cast<int>(g.size()) && g[i] != 0; };
    for (std::size_t k = 0; k < t.row.size(); ++k) among_wet += is_wet(t.row[k]) && is_wet(t.col[k]);
    wet = std::ranges::count_if(g, [](double v) { return v != 0; });
    std::set<int> nodes;
    for (const Quad& q : scene.mesh.surfaces.at("inner")) nodes.insert(q.begin(), q.end());
    wet_nodes = static_cast<long long>(nodes.size());
    for (int node : nodes)
      for (double x : scene.mesh.points[node]) bounds += std::abs(x) < 1e-9;
    EXPECT_EQ(liquid_entries(*system), formulation == Formulation::bordered ? 2 * wet + 1 : wet * wet + 1);
    EXPECT_EQ(liquid_entries(*system, Triangles::upper),
              formulation == Formulation::bordered ? wet + 1 : wet * (wet + 1) / 2 + 1);
    EXPECT_EQ(assemble(CoupledOperator(system), Triangles::upper).row.size(),
              (t.row.size() + system->size()) / 2);
  }
};

// Of k wet nodes: 2·3k + 1 numbers bordered, (3k)² eliminated, 3k less what the symmetry planes hold.
TEST(Formulations, LiquidAddsLinearlyBorderedAndQuadraticallyEliminated) {
  for (int n : {2, 4, 8}) {
    const Counted bordered(n, Formulation::bordered), eliminated(n, Formulation::eliminated);
    EXPECT_EQ(bordered.wet, 3 * bordered.wet_nodes - bordered.bounds) << n;
    EXPECT_EQ(bordered.entries - bordered.dry_entries, 2 * bordered.wet)
        << n;  // and P's diagonal, which is always there
    EXPECT_EQ(eliminated.among_wet, eliminated.wet * eliminated.wet) << n;
    EXPECT_EQ(eliminated.entries - eliminated.dry_entries,
              eliminated.wet * eliminated.wet - bordered.among_wet)
        << n;
  }
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
