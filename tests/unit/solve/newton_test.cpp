#include "core/solve/newton.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/solve/march.hpp"
#include "tests/support/models.hpp"

namespace bulbus {
namespace {

/// A march with the direct solver that remembers what it saw.
struct Trial : MarchObserver {
  Comm comm;
  Mesh mesh;
  Problem problem;
  SolverSettings settings;
  Meters meters;
  State state;
  MarchReport report;
  std::vector<Increment> increments;
  std::vector<NewtonReport> cuts;

  explicit Trial(const Scene& scene, const Comm& c = {}) : comm(c), mesh(scene.mesh), problem(scene.mesh, scene.model, c), state(problem.initial_state()) {
    settings.newton = {.force = 1e-10, .volume = 1e-10, .liquid = 1e-10};
  }
  void increment_done(const Increment& i, const State&) override { increments.push_back(i); }
  void increment_cut(const NewtonReport& r, double, double) override { cuts.push_back(r); }
  Trial& go(double gamma = 0) {
    settings.linear.gamma = gamma;
    settings.linear.op = "recompute";
    CoupledSystem system(problem, settings.linear);
    const auto solver = make_direct_solver(settings.linear, meters);
    report = march(problem, system, *solver, state, settings, meters, *this);
    return *this;
  }
  /// Local nodes of a set of the mesh, in use by the model or not.
  std::vector<int> nodes(const std::string& set) const { return problem.mesh().local(nodes_of(mesh, set)); }
  /// Force on a set of held nodes along an axis.
  double reaction(const std::string& set, int axis) const {
    const Residual r = problem.residual(state);
    double sum = 0;
    for (int n : nodes(set))
      if (n < problem.mesh().owned) sum += r.force[3 * n + axis];
    return comm.sum(sum);
  }
};

/// A shell octant filled with liquid at 0.05 MPa, then 8 % more of it.
Scene inflated_shell() {
  Scene s = filled_shell("octant");
  s.model.steps[1].add["fluid"] = 2.5;
  s.model.steps[0].displace.clear();
  s.model.steps[1].displace.clear();
  return s;
}

/// Every later iteration squares the distance, as far as round-off lets it.
void expect_quadratic(const NewtonReport& r) {
  std::vector<double> e;
  for (const auto& i : r.iterations) e.push_back(std::max({i.balance.force, i.balance.volume, i.balance.liquid}));
  e.push_back(std::max({r.balance.force, r.balance.volume, r.balance.liquid}));
  ASSERT_GE(e.size(), 3u);
  for (std::size_t k = 1; k + 1 < e.size(); ++k)
    if (e[k] < .1) {
      EXPECT_LT(e[k + 1], std::max(100 * e[k] * e[k], 1e-13)) << k << ' ' << e[k];
    }
}

TEST(March, UniaxialStretchHasTheExactNominalStress) {
  for (double dz : {.4, -.3}) {
    Trial run(stretched_block(2, std::to_string(dz)));
    run.go();
    ASSERT_TRUE(run.report.converged) << run.report.reason;
    const double l = 1 + dz, expected = 2 * .5 * (l - 1 / (l * l));
    EXPECT_NEAR(run.reaction("zmax", 2), expected, 1e-9);
    const double side = 1 / std::sqrt(l);
    for (int n : run.nodes("xmax")) EXPECT_NEAR(run.state.x[3 * n], side, 1e-9);
    for (double lambda : run.state.lambda)  // no stress across: τ_xx = 2 c10 (b − tr b / 3), λ = −τ_xx
      EXPECT_NEAR(lambda, -((1 / l) - (l * l + 2 / l) / 3), 1e-9);
  }
}

TEST(March, GammaDoesNotMatterToTheDirectSolver) {
  Trial plain(stretched_block(2, "0.4")), augmented(stretched_block(2, "0.4"));
  plain.go(0), augmented.go(10);
  ASSERT_TRUE(augmented.report.converged);
  EXPECT_EQ(augmented.report.newton_iterations, plain.report.newton_iterations);
  EXPECT_NEAR(augmented.reaction("zmax", 2), plain.reaction("zmax", 2), 1e-10);
}

TEST(March, ConvergesQuadratically) {
  for (const char* what : {"stretch", "inflation"}) {
    Trial run(what == std::string("stretch") ? stretched_block(2, "0.4") : inflated_shell());
    run.go();
    ASSERT_TRUE(run.report.converged) << run.report.reason;
    EXPECT_EQ(run.report.cuts, 0);
    for (const Increment& i : run.increments) {
      expect_quadratic(i.newton);
      EXPECT_LE(i.newton.iterations.size(), 8u);
    }
  }
}

TEST(March, RigidBodiesSkewHoldsBarsAndLiquidConvergeQuadraticallyToo) {
  Scene scene = filled_shell("half");
  scene.mesh.node_sets["seat"] = nodes_where(scene.mesh, [](const Point& p) { return p[2] < -.9 * norm(p); });
  scene.model.fix.push_back({"seat", {"y", "z"}});
  Trial run(scene);
  run.go();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  for (const Increment& i : run.increments) expect_quadratic(i.newton);
  EXPECT_LT(run.increments.back().newton.balance.force, 1e-10);
}

TEST(March, NegativePivotsAreHexahedraAndLiquids) {
  Trial run(inflated_shell());
  run.go();
  ASSERT_EQ(run.increments.size(), 2u);
  for (const Increment& i : run.increments) EXPECT_EQ(i.newton.negative_pivots, run.problem.mesh().all_hexes + 1);
  Trial stretch(stretched_block(2, "0.4"));
  EXPECT_EQ(stretch.go().increments.back().newton.negative_pivots, 8);
}

// Elimination is exact: iterates, pivots and answers are those of the bordered system up to round-off.
TEST(March, EliminatedPressureGivesTheSameAnswerByTheSameIterations) {
  Trial bordered(inflated_shell()), eliminated(inflated_shell());
  eliminated.settings.linear.formulation = "eliminated";
  bordered.go(), eliminated.go();
  ASSERT_TRUE(eliminated.report.converged) << eliminated.report.reason;
  EXPECT_EQ(eliminated.report.newton_iterations, bordered.report.newton_iterations);
  ASSERT_EQ(eliminated.increments.size(), bordered.increments.size());
  for (std::size_t i = 0; i < eliminated.increments.size(); ++i)
    EXPECT_EQ(eliminated.increments[i].newton.negative_pivots, bordered.increments[i].newton.negative_pivots);
  EXPECT_LT(relative_difference(eliminated.state.x, bordered.state.x), 1e-11);
  EXPECT_LT(relative_difference(eliminated.state.P, bordered.state.P), 1e-11);
}

TEST(March, ReportsTheFactors) {
  for (const std::string formulation : {"bordered", "eliminated"}) {
    Trial run(inflated_shell());
    run.settings.linear.formulation = formulation;
    run.go();
    const auto& factor = run.increments.back().newton.iterations.back().linear.factor;
    ASSERT_TRUE(factor);
    EXPECT_GT(factor->matrix_entries, 1000);
    EXPECT_GT(factor->factor_entries, factor->matrix_entries);
    EXPECT_GT(factor->flops, 1e5);
    EXPECT_EQ(factor->negative_pivots, run.increments.back().newton.negative_pivots);
  }
}

// Smaller increments do not help: it says why and stops at once.
TEST(March, RefusesWhatDoesNotFitIntoMemory) {
  for (const std::string formulation : {"bordered", "eliminated"}) {
    Trial run(inflated_shell());
    run.settings.linear.formulation = formulation;
    run.settings.linear.memory_limit = 1e-3;
    run.go();
    EXPECT_FALSE(run.report.converged);
    EXPECT_EQ(run.report.cuts, 1);
    ASSERT_EQ(run.cuts.size(), 1u);
    EXPECT_EQ(run.cuts[0].outcome, Outcome::too_large);
    EXPECT_NE(run.report.reason.find("MB allowed"), std::string::npos) << run.report.reason;
    EXPECT_EQ(run.report.reason.find("smallest increment"), std::string::npos) << run.report.reason;
  }
}

TEST(March, EnclosedLiquidObeysItsLaw) {
  Trial run(inflated_shell());
  run.go();
  ASSERT_TRUE(run.report.converged);
  const double P = run.state.P[0], V = run.problem.liquids()[0].volume(run.state.x);
  EXPECT_GT(P, .05);
  EXPECT_NEAR(run.problem.residual(run.state).liquid[0], 0, 1e-9 * V);
}

TEST(March, ReportsWhatItDid) {
  Scene scene = stretched_block(2, "0.4");
  scene.model.steps[0].increments = 4;
  scene.model.steps.push_back(step("rest"));
  Trial run(scene);
  run.go();
  EXPECT_TRUE(run.report.converged);
  EXPECT_EQ(run.report.increments, 5);
  ASSERT_EQ(run.increments.size(), 5u);
  EXPECT_EQ(run.increments[2].number, 3);
  EXPECT_EQ(run.increments[2].step_name, "stretch");
  EXPECT_NEAR(run.increments[2].progress, .75, 1e-14);
  EXPECT_EQ(run.increments[3].progress, 1);
  EXPECT_EQ(run.increments[4].time, 2);
  EXPECT_EQ(run.increments[4].newton.iterations.size(), 0u);  // already there
  int iterations = 0;
  for (const auto& i : run.increments) iterations += static_cast<int>(i.newton.iterations.size());
  EXPECT_EQ(run.report.newton_iterations, iterations);
}

TEST(March, ScalesTheIncrementsOfEveryStep) {
  Scene scene = stretched_block(2, "0.4");
  scene.model.steps[0].increments = 4;
  for (const auto& [factor, increments] : {std::pair{.25, 1}, {.3, 2}, {.5, 2}, {1., 4}, {2., 8}}) {
    Trial run(scene);
    run.settings.stepping.increments = factor;
    EXPECT_EQ(run.go().report.increments, increments) << factor;
  }
}

TEST(March, IsLaxUnderwayAndStrictAtTheEnd) {
  Scene scene = stretched_block(2, "0.4");
  scene.model.steps[0].increments = 4;
  Trial strict(scene), lax(scene);
  lax.settings.newton.underway = 1e6;
  strict.go(), lax.go();
  EXPECT_LT(lax.report.newton_iterations, strict.report.newton_iterations);
  for (int i = 0; i < 4; ++i) {
    const Balance &left = lax.increments[i].newton.balance, &right = strict.increments[i].newton.balance;
    EXPECT_LE(std::max(right.force, right.volume), 1e-10);
    EXPECT_EQ(std::max(left.force, left.volume) > 1e-10, i < 3) << i;
  }
  EXPECT_NEAR(lax.reaction("zmax", 2), strict.reaction("zmax", 2), 1e-9);
}

/// Fails until it is renewed, as a solver may that keeps its preconditioner.
struct Stale final : LinearSolver {
  std::unique_ptr<LinearSolver> inner;
  int renewals = 0;
  explicit Stale(std::unique_ptr<LinearSolver> solver) : inner(std::move(solver)) {}
  LinearReport prepare(CoupledSystem& system) override { return inner->prepare(system); }
  LinearReport solve(const CoupledSystem& system, std::vector<double> b, std::span<double> x, double tolerance) override {
    if (renewals == 0) return {.reason = "old", .stale = true, .iterations = 7};
    return inner->solve(system, b, x, tolerance);
  }
  void renew() override { ++renewals; }
};

TEST(Newton, SolvesAgainWithANewPreconditionerWhereAnOldOneFails) {
  Trial t(stretched_block(2, "0.4"));
  t.settings.linear.gamma = 0;
  CoupledSystem system(t.problem, t.settings.linear);
  Stale solver(make_direct_solver(t.settings.linear, t.meters));
  t.problem.begin_step(0, t.state);
  const NewtonReport r = newton(t.problem, system, solver, t.state, 1, t.settings.newton, t.meters, {});
  EXPECT_EQ(r.outcome, Outcome::converged) << r.reason;
  EXPECT_EQ(solver.renewals, 1);
  EXPECT_EQ(r.krylov_iterations, 7);  // what was spent is counted
}

TEST(March, CutsIncrementsThatNeedTooManyIterations) {
  Trial run(stretched_block(2, "1.5"));
  run.settings.newton.max_iterations = 4;
  run.go();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  EXPECT_GT(run.report.cuts, 0);
  EXPECT_EQ(run.report.cuts, static_cast<int>(run.cuts.size()));
  EXPECT_NEAR(run.reaction("zmax", 2), 2.5 - 1 / 6.25, 1e-8);
  for (const auto& cut : run.cuts) EXPECT_NE(cut.outcome, Outcome::converged);
}

TEST(March, ImpossibleStepFailsWithAReasonAndKeepsTheLastGoodState) {
  Trial run(stretched_block(2, "-1.2"));
  run.settings.stepping.smallest = .02;
  run.go();
  EXPECT_FALSE(run.report.converged);
  EXPECT_GT(run.report.cuts, 0);
  EXPECT_NE(run.report.reason.find("step 'stretch' stopped at 0."), std::string::npos) << run.report.reason;
  EXPECT_NE(run.report.reason.find("smallest increment reached"), std::string::npos) << run.report.reason;
  EXPECT_GT(run.comm.min(run.problem.solid().least_jacobian(run.state.x)), 0);
  const double done = run.increments.back().progress;
  EXPECT_NEAR(run.problem.progress(), done, 1e-14);
  const Balance b = run.problem.balance(run.problem.residual(run.state));
  EXPECT_LT(b.force, 1e-9);
  EXPECT_LT(b.volume, 1e-9);
}

TEST(March, RefusesConstraintsThatLeaveARegionTheWrongVolume) {
  Scene scene = stretched_block(2, "0.2");  // incompressible and held on all sides: volume cannot change
  for (const char* side : {"xmax", "ymax"}) scene.model.fix.push_back({side, {std::string(1, side[0])}});
  Trial run(scene);
  try {
    run.go();
    ADD_FAILURE() << "not refused";
  } catch (const InputError& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("0.2 mm3 are missing"), std::string::npos) << refusal.what();
  }
}

TEST(March, DeadLoadReachesItsEquilibrium) {
  Scene scene = stretched_block(2, "0");
  scene.model.steps[0].displace.clear();
  LoadSpec pull;
  pull.surface = "zmax", pull.pressure = "-0.5", pull.dead = true;
  scene.model.steps[0].loads.push_back(pull);
  Trial run(scene);
  run.go();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  const auto top = run.nodes("zmax");
  if (top.empty()) return;
  const double l = run.state.x[3 * top[0] + 2];
  EXPECT_NEAR(l - 1 / (l * l), .5, 1e-8);  // nominal stress
}

TEST(March, FollowerPressureReachesItsEquilibriumAlthoughUnsymmetric) {
  Scene scene = stretched_block(2, "0");
  scene.model.steps[0].displace.clear();
  LoadSpec pull;
  pull.surface = "zmax", pull.pressure = "-0.5";
  scene.model.steps[0].loads.push_back(pull);
  Trial run(scene);
  run.go();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  for (const Increment& i : run.increments) {
    expect_quadratic(i.newton);
    EXPECT_EQ(i.newton.negative_pivots, -1);
  }
  const auto top = run.nodes("zmax");
  if (top.empty()) return;
  const double l = run.state.x[3 * top[0] + 2];
  EXPECT_NEAR(l * l - 1 / l, .5, 1e-8);  // Cauchy stress
}

TEST(March, RigidLidTurnsUnderACouple) {
  Scene scene{generate(BlockShape{.upper = {2, 1, 3}, .nx = 2, .ny = 2, .nz = 3}), {}};
  split_region(scene.mesh, "lid", [](const Point& p) { return p[2] > 2; });
  scene.model.regions = {{"block", neo_hooke(.5)}, {"lid", rigid()}};
  scene.model.fix.push_back({"zmin", {"x", "y", "z"}});
  scene.mesh.node_sets["left"] = nodes_where(scene.mesh, [](const Point& p) { return p[2] == 3 && p[0] == 0; });
  scene.mesh.node_sets["right"] = nodes_where(scene.mesh, [](const Point& p) { return p[2] == 3 && p[0] == 2; });
  StepSpec s = step("turn");
  LoadSpec up, down;
  up.set = "left", up.force = Point{0, 0, .03};
  down.set = "right", down.force = Point{0, 0, -.03};
  s.loads = {up, down};
  scene.model.steps = {s};
  Trial run(scene);
  run.go();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  expect_quadratic(run.increments.back().newton);
  EXPECT_GT(run.state.bodies[0].rotation(0, 2), .01);  // the left rises: z leans to +x
  EXPECT_NEAR(norm(run.problem.residual(run.state).bodies[0].moment), 0, 1e-9);
}

TEST(March, ResultsAreTheSameHoweverManyRanks) {
  Trial run(filled_shell("octant")), alone(filled_shell("octant"), Comm(MPI_COMM_SELF));
  run.go(), alone.go();
  ASSERT_TRUE(run.report.converged && alone.report.converged);
  EXPECT_NEAR(run.state.P[0], alone.state.P[0], 1e-9);
  std::vector<int> local_of(alone.problem.mesh().nodes());
  for (int n = 0; n < alone.problem.mesh().nodes(); ++n) local_of[alone.problem.mesh().input_node[n]] = n;
  for (int n = 0; n < run.problem.mesh().nodes(); ++n)
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR(run.state.x[3 * n + c], alone.state.x[3 * local_of[run.problem.mesh().input_node[n]] + c], 1e-8);
}

TEST(Newton, NothingToDoTakesNoIteration) {
  const Scene scene = stretched_block(2, "0");
  const Comm comm;
  Problem problem(scene.mesh, scene.model, comm);
  State state = problem.initial_state();
  problem.begin_step(0, state);
  Meters meters;
  CoupledSystem system(problem, {});
  const auto solver = make_direct_solver({}, meters);
  int seen = 0;
  const NewtonReport r = newton(problem, system, *solver, state, 1, {}, meters, [&](const NewtonIteration&) { ++seen; });
  EXPECT_EQ(r.outcome, Outcome::converged);
  EXPECT_TRUE(r.iterations.empty());
  EXPECT_EQ(seen, 1);
}

TEST(Newton, NotANumberIsNoticed) {
  const Scene scene = stretched_block(2, "0.1");
  const Comm comm;
  Problem problem(scene.mesh, scene.model, comm);
  State state = problem.initial_state();
  problem.begin_step(0, state);
  if (!state.lambda.empty() && comm.rank() == 0) state.lambda[0] = NAN;
  Meters meters;
  CoupledSystem system(problem, {});
  const auto solver = make_direct_solver({}, meters);
  EXPECT_EQ(newton(problem, system, *solver, state, 1, {}, meters).outcome, Outcome::not_finite);
}

TEST(Newton, EveryOutcomeHasWords) {
  for (Outcome o : {Outcome::converged, Outcome::inverted_element, Outcome::linear_solver_failed, Outcome::too_many_iterations, Outcome::not_finite})
    EXPECT_FALSE(describe(o).empty());
}

/// Runs out of memory after some linear solves.
struct Hungry : LinearSolver {
  std::unique_ptr<LinearSolver> inner;
  int left;
  Hungry(std::unique_ptr<LinearSolver> solver, int solves) : inner(std::move(solver)), left(solves) {}
  LinearReport prepare(CoupledSystem& system) override { return inner->prepare(system); }
  LinearReport solve(const CoupledSystem& system, std::vector<double> b, std::span<double> x, double tolerance) override {
    if (left-- <= 0) throw std::bad_alloc();
    return inner->solve(system, std::move(b), x, tolerance);
  }
};

TEST(March, WithoutMemoryEndsWithTheLastGoodState) {
  Trial trial(inflated_shell(), Comm(MPI_COMM_SELF));
  trial.settings.linear.gamma = 0;
  CoupledSystem system(trial.problem, trial.settings.linear);
  Trial whole(inflated_shell(), Comm(MPI_COMM_SELF));
  whole.go();
  ASSERT_GT(whole.increments.size(), 1u);
  const int enough = static_cast<int>(whole.increments[0].newton.iterations.size()) + 1;
  Hungry solver(make_direct_solver(trial.settings.linear, trial.meters), enough);
  const MarchReport report = march(trial.problem, system, solver, trial.state, trial.settings, trial.meters, trial);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.reason.find("out of memory"), std::string::npos) << report.reason;
  ASSERT_EQ(trial.increments.size(), 1u);
  EXPECT_EQ(report.increments, 1);
  for (double x : trial.state.x) EXPECT_TRUE(std::isfinite(x));
}

}  // namespace
}  // namespace bulbus
