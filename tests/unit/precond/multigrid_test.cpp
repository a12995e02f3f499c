#include "precond/coarse/multigrid.hpp"
#include "core/base/error.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/solve/assemble.hpp"
#include "precond/operators/displacement.hpp"
#include "precond/operators/projected_tangent.hpp"
#include "precond/smoothers/chebyshev.hpp"
#include "tests/support/linearised.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

TEST(Lines, RunThroughTheThicknessOfAPlate) {
  const Problem problem(thin_plate().mesh, thin_plate().model, Comm());
  const Lines lines = find_lines(problem);
  ASSERT_EQ(lines.count(), 25);
  const auto& X = problem.mesh().X;
  for (int k = 0; k < lines.count(); ++k) {
    ASSERT_EQ(lines.start[k + 1] - lines.start[k], 4);
    for (int i = lines.start[k]; i + 1 < lines.start[k + 1]; ++i) {
      const int a = lines.nodes[i], b = lines.nodes[i + 1];
      EXPECT_EQ(X[3 * a], X[3 * b]);
      EXPECT_EQ(X[3 * a + 1], X[3 * b + 1]);
      EXPECT_NEAR(std::abs(X[3 * a + 2] - X[3 * b + 2]), .5 / 3, 1e-12);
    }
  }
}

TEST(Lines, AreSingleNodesWhereNothingIsThin) {
  Scene cube = stretched_block(4, ".1");
  EXPECT_GT(find_lines(Problem(cube.mesh, cube.model, Comm())).count(), 60);
}

TEST(Lines, HoldEveryNodeOfTheEyeOnceAndCoupleNeighboursOnly) {
  const Scene eye = small_eye(8);
  const Problem problem(eye.mesh, eye.model, Comm());
  const Lines lines = find_lines(problem);
  std::vector<int> line(problem.mesh().owned, -1), position(line);
  for (int k = 0; k < lines.count(); ++k)
    for (int i = lines.start[k]; i < lines.start[k + 1]; ++i) {
      EXPECT_EQ(line[lines.nodes[i]], -1);
      line[lines.nodes[i]] = k;
      position[lines.nodes[i]] = i;
    }
  EXPECT_EQ(lines.nodes.size(), line.size());
  EXPECT_LT(lines.count(), .4 * line.size());
  for (const Hex& h : problem.mesh().hexes)
    for (int a : h)
      for (int b : h) EXPECT_TRUE(line[a] != line[b] || std::abs(position[a] - position[b]) <= 1);
}

// On one line of the plate: A · (D⁻¹ r) = r there, if nothing else is touched.
TEST(LineJacobi, InvertsTheBlockOfEveryLine) {
  const Linearised l(thin_plate(), 0, .01);
  const Lines lines = find_lines(l.problem);
  const LineJacobi D(*l.system, std::make_shared<Lines>(lines));
  const DisplacementBlock A(l.system);
  std::vector<double> r(D.size()), y(r), z(r);
  for (int k : {0, 7, 24}) {
    std::fill(r.begin(), r.end(), 0);
    for (int i = lines.start[k]; i < lines.start[k + 1]; ++i)
      for (int c = 0; c < 3; ++c) r[3 * lines.nodes[i] + c] = noise(5, 3 * i + c);
    D.apply(r, y);
    A.apply(y, z);
    for (int i = lines.start[k]; i < lines.start[k + 1]; ++i)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(z[3 * lines.nodes[i] + c], r[3 * lines.nodes[i] + c], 1e-4);
  }
}

TEST(Multigrid, IsSymmetricAndPositive) {
  for (const Scene& scene : {thin_plate(), cylinder(), filled_shell("octant")}) {
    Linearised l(scene, 1, .002);
    const auto plan = std::make_shared<MultigridPlan>(l.problem, l.settings);
    const Multigrid M(l.system, plan, {});
    const auto a = noise_primal(l.problem, 1), b = noise_primal(l.problem, 2);
    std::vector<double> Ma(a.size(), std::nan("")), Mb(a.size(), std::nan(""));
    M.apply(a, Ma);
    M.apply(b, Mb);
    EXPECT_NEAR(inner(b, Ma), inner(a, Mb), 1e-5 * std::sqrt(inner(a, Ma) * inner(b, Mb)));
    EXPECT_GT(inner(a, Ma), 0);
    EXPECT_TRUE(M.is_linear());
  }
}

TEST(Multigrid, BringsTheSpectrumTogether) {
  for (const Scene& scene : {thin_plate(), cylinder()})
    for (int refine : {1, 2}) {
      Linearised l(scene, refine, 0);
      const auto plan = std::make_shared<MultigridPlan>(l.problem, l.settings);
      const Multigrid M(l.system, plan, {});
      const Spectrum s = lanczos(DisplacementBlock(l.system), M, 30, Comm());
      EXPECT_GT(s.smallest, .3) << refine;
      EXPECT_LT(s.largest, 1.2) << refine;
    }
}

// The coarser system is what a problem on the base mesh has in the injected state.
TEST(Multigrid, CoarseLevelsAreRediscretised) {
  const Scene scene = filled_shell("half");
  Linearised l(scene, 1, .002);
  const auto plan = std::make_shared<MultigridPlan>(l.problem, l.settings);
  const Multigrid M(l.system, plan, {});
  Problem base(scene.mesh, scene.model, Comm());
  State state = l.problem.coarsened(l.state);
  base.begin_step(0, base.initial_state());
  State progress = base.initial_state();
  base.set_progress(.1, progress);
  const CoupledSystem system(base, l.settings, state, base.residual(state));
  const auto x = noise_primal(base, 3);
  std::vector<double> y(x.size()), z(x.size());
  system.apply_displacement(x, y);
  plan->levels()[0].coarser->apply_displacement(x, z);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], z[i], 1e-10);
}

// K = sum of s_i u uᵀ on some nodes.
struct SpringTangent final : TermTangent {
  std::vector<int> nodes;
  double stiffness = 1;
  void add_action(std::span<const double> dx, std::span<double> force) const override {
    for (int n : nodes)
      for (int c = 0; c < 3; ++c) force[3 * n + c] += stiffness * (1 + c) * dx[3 * n + c];
  }
  void visit(const ContributionVisitor& visitor) const override {
    const double k = stiffness;
    const std::array<double, 9> K{k, 0, 0, 0, 2 * k, 0, 0, 0, 3 * k};
    for (int n : nodes) visitor(std::span(&n, 1), K);
  }
};

struct Springs final : Term {
  SpringTangent K;
  void add_residual(const State&, std::span<double>, std::span<double>) const override {}
  std::shared_ptr<const TermTangent> tangent(const std::shared_ptr<const State>&) const override {
    return std::make_shared<SpringTangent>(K);
  }
};

TEST(ProjectedTangent, IsTheGalerkinProjection) {
  const Scene scene = thin_plate();
  Problem problem(refined(scene.mesh, 1), scene.model, Comm());
  auto springs = std::make_shared<Springs>();
  springs->K.nodes = problem.nodes_of("zmax");
  problem.add(springs);
  const auto& coarse = *problem.coarser();
  const Interpolation P =
      problem.prolongation().at(coarse.mesh().X, problem.mesh().X, coarse.solid().reference_volumes());
  const State state = problem.initial_state();
  const ProjectedTangent projected(CoupledSystem(problem, {}, state, problem.residual(state)), P);
  std::vector<double> x(problem.coarser()->mesh().X.size()), Px(problem.mesh().X.size()), KPx(Px), want(x),
      got(x), visited(x);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = noise(1, static_cast<int>(i));
  P.apply(x, Px);
  springs->K.add_action(Px, KPx);
  P.apply_transposed(KPx, want);
  std::fill(got.begin(), got.end(), 0);
  projected.add_action(x, got);
  projected.visit([&](std::span<const int> nodes, std::span<const double> K) {
    const std::size_t n = 3 * nodes.size();
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        visited[3 * nodes[i / 3] + i % 3] += K[i * n + j] * x[3 * nodes[j / 3] + j % 3];
  });
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(got[i], want[i], 1e-13);
    EXPECT_NEAR(visited[i], want[i], 1e-13);
  }
}

TEST(Multigrid, TakesAsFewIterationsOnEveryMesh) {
  for (int refine : {1, 2}) {
    EXPECT_LE(iterations(stretched_block(2, ".1"), refine, Displacement::multigrid), 14) << refine;
    EXPECT_LE(iterations(thin_plate(), refine, Displacement::multigrid), 16) << refine;
  }
  EXPECT_LE(iterations(small_eye(8), 1, Displacement::multigrid),
            36);  // at rest, where the element pressures decide
}

TEST(Multigrid, OfTwoSolversOfOneProblemIsThatOfEachAlone) {
  const Scene scene = stretched_block(2, ".1");
  Problem problem(refined(scene.mesh, 1), scene.model, Comm());
  auto springs = std::make_shared<Springs>();
  springs->K.nodes.resize(problem.mesh().owned);
  std::iota(springs->K.nodes.begin(), springs->K.nodes.end(), 0);
  springs->K.stiffness = 20;
  problem.add(springs);
  State state = problem.initial_state();
  problem.begin_step(0, state);
  problem.set_progress(.1, state);
  LinearSettings settings;
  settings.take_mesh(1);
  const auto system =
      std::make_shared<const CoupledSystem>(problem, settings, state, problem.residual(state));
  Profiler profiler;
  std::vector<double> b(system->size());
  for (int i = 0; i < 3 * problem.mesh().owned; ++i) b[i] = noise(3, i);
  std::vector<std::vector<double>> found;
  std::vector<std::unique_ptr<LinearSolver>> solvers;  // all of them live on
  for (int k = 0; k < 3; ++k) {
    solvers.push_back(
        make_krylov_solver(settings, make_preconditioner_factory(settings, profiler), profiler));
    const Preparation prepared = solvers.back()->prepare(system);
    ASSERT_TRUE(prepared.ok);
    found.emplace_back(system->size());
    const LinearReport report =
        solvers.back()->solve(CoupledOperator(system, prepared.augmentation), b, found.back(), 1e-6);
    ASSERT_TRUE(report.ok) << report.reason;
  }
  EXPECT_TRUE(problem.coarser()->added().empty()) << "a preconditioner leaves the problem as it is";
  EXPECT_EQ(found[1], found[0]) << "to the last digit: the preconditioner is the same";
  EXPECT_EQ(found[2], found[0]);
}

TEST(Multigrid, NeedsARefinedMesh) {
  Linearised l(thin_plate(), 0, 0);
  l.settings.displacement = Displacement::multigrid;
  EXPECT_THROW(DisplacementFactory(l.settings).make(l.system), InputError);
}

TEST(Displacement, AutoTakesMultigridWhereTheMeshIsRefined) {
  const Scene scene = thin_plate();
  const auto on = [](const LinearSettings& settings, const Problem& problem) {
    return settings.displacement_on(problem.coarser());
  };
  EXPECT_EQ(on({}, Problem(scene.mesh, scene.model, Comm())), Displacement::aggregation);
  const Problem fine(refined(scene.mesh, 1), scene.model, Comm());
  EXPECT_EQ(on({}, fine), Displacement::multigrid);
  EXPECT_EQ(on({.displacement = Displacement::jacobi}, fine), Displacement::jacobi);
}

}  // namespace
}  // namespace bulbus
