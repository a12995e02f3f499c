#include "core/solve/march.hpp"

#include <gtest/gtest.h>

#include "tests/support/not_empty.hpp"
#include "tests/unit/solve/trial.hpp"

namespace bulbus {
namespace {

using namespace test;

// Smaller increments do not help: it says why and stops at once.
TEST(March, RefusesWhatDoesNotFitIntoMemory) {
  for (const Formulation formulation : {Formulation::bordered, Formulation::eliminated}) {
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

TEST(March, CutsIncrementsThatNeedTooManyIterations) {
  Trial run(stretched_block(2, "1.5"));
  run.settings.newton.max_iterations = 4;
  run.go();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  EXPECT_GT(run.report.cuts, 0);
  EXPECT_EQ(run.report.cuts, static_cast<int>(run.cuts.size()));
  EXPECT_NEAR(run.reaction("zmax", 2), 2.5 - 1 / 6.25, 1e-8);
  for (const auto& cut : not_empty(run.cuts)) EXPECT_NE(cut.outcome, Outcome::converged);
}

TEST(March, ImpossibleStepFailsWithAReasonAndKeepsTheLastGoodState) {
  Trial run(stretched_block(2, "-1.2"));
  run.settings.stepping.minimum = .02;
  run.go();
  EXPECT_FALSE(run.report.converged);
  EXPECT_GT(run.report.cuts, 0);
  EXPECT_NE(run.report.reason.find("step 'stretch' stopped at 0."), std::string::npos) << run.report.reason;
  EXPECT_NE(run.report.reason.find("smallest increment reached"), std::string::npos) << run.report.reason;
  EXPECT_GT(run.comm.min(run.problem.solid().least_jacobian(run.state.x)), 0);
  const double done = run.increments.back().progress;
  EXPECT_NEAR(run.problem.progress(), done, 1e-14);
  const EquilibriumError b = run.problem.equilibrium_error(run.problem.residual(run.state));
  EXPECT_LT(b.force, 1e-9);
  EXPECT_LT(b.volume, 1e-9);
}

// Increments that are shorter than the minimum from the start are halved all the same.
TEST(March, HalvesShortIncrementsFourTimes) {
  Scene scene = stretched_block(2, "0.5");
  scene.model.steps[0].increments = 2000;
  Trial run(scene);
  run.settings.newton.max_iterations = 1;
  run.settings.newton.force = 1e-15;
  ASSERT_GT(run.settings.stepping.minimum, 1. / 2000);
  run.go();
  EXPECT_FALSE(run.report.converged);
  EXPECT_EQ(run.tried.front(), 1. / 2000);
  EXPECT_EQ(run.tried.back(), 1. / 32000);
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

/// Between two parts of a step it pulls at one node with a force that changes with every linearisation and
/// comes back after four: what is out of balance is large and small in turn.
struct Flickering : Term {
  double from, to, s = 0;
  int node = 0;
  mutable int linearisations = 0;
  Flickering(const LocalMesh& mesh, double a, double b) : from(a), to(b) {
    const auto off_middle = [&](int n) {
      return norm(Vec3<double>{mesh.X[3 * n] - .5, mesh.X[3 * n + 1] - .5, mesh.X[3 * n + 2] - .5});
    };
    for (int n = 0; n < mesh.nodes(); ++n)
      if (off_middle(n) < off_middle(node)) node = n;
  }
  void add_residual(const State&, std::span<double> force, std::span<double>) const override {
    constexpr std::array pulls{1., 1.01, .01, 0.};
    if (s > from && s < to) force[3 * node + 2] += 1e-3 * pulls[linearisations % pulls.size()];
  }
  std::shared_ptr<const TermTangent> tangent(const std::shared_ptr<const State>&) const override {
    ++linearisations;
    return nullptr;
  }
  void set_progress(double now) override { s = now; }
};

// From .5 on nothing near by converges, and from .9 on all does: it says that it has leapt.
TEST(March, LeapsOverWhatCyclesAndSaysSo) {
  for (double end : {.9, 2.}) {
    Scene scene = stretched_block(2, "0.2");
    scene.model.steps[0].increments = 4;
    Trial run(scene, Comm(MPI_COMM_SELF));
    run.problem.add(std::make_shared<Flickering>(run.problem.mesh(), .51, end));
    run.go();
    ASSERT_FALSE(run.cuts.empty());
    EXPECT_EQ(run.cuts.front().outcome, Outcome::cycling);
    EXPECT_EQ(run.report.converged, end < 1) << run.report.reason;
    EXPECT_EQ(run.increments.back().leap, end < 1);
    if (end < 1) {
      EXPECT_LT(run.increments.back().start, .52);
      EXPECT_GT(run.increments.back().progress, .9);
    }
  }
}

/// Runs out of memory after some linear solves.
struct Hungry : LinearSolver {
  std::unique_ptr<LinearSolver> inner;
  int left;
  Hungry(std::unique_ptr<LinearSolver> solver, int solves) : inner(std::move(solver)), left(solves) {}
  Preparation prepare(SharedSystem system) override { return inner->prepare(std::move(system)); }
  LinearReport solve(const CoupledOperator& A, std::vector<double> b, std::span<double> x,
                     double tolerance) override {
    if (left-- <= 0) throw std::bad_alloc();
    return inner->solve(A, std::move(b), x, tolerance);
  }
};

TEST(March, WithoutMemoryEndsWithTheLastGoodState) {
  Trial trial(inflated_shell(), Comm(MPI_COMM_SELF));
  trial.settings.linear.gamma = 0;
  Trial whole(inflated_shell(), Comm(MPI_COMM_SELF));
  whole.go();
  ASSERT_GT(whole.increments.size(), 1u);
  const int enough = static_cast<int>(whole.increments[0].newton.iterations.size()) + 1;
  Hungry solver(make_direct_solver(trial.settings.linear, trial.profiler), enough);
  const MarchReport report = march(trial.problem, solver, trial.state, trial.settings, trial.profiler, trial);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.reason.find("out of memory"), std::string::npos) << report.reason;
  ASSERT_EQ(trial.increments.size(), 1u);
  EXPECT_EQ(report.increments, 1);
  for (double x : trial.state.x) EXPECT_TRUE(std::isfinite(x));
}

}  // namespace
}  // namespace bulbus
