#include "precond/make_preconditioner.hpp"
#include "tests/support/linearised.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

// Solves the present Newton step to 1e-6 in the norm of the solver.
LinearReport solve(Linearised& l, LinearSolver& solver) {
  EXPECT_TRUE(solver.prepare(l.system).ok);
  std::vector<double> held(l.state.x.size()), x(l.system.size()), Ax(x);
  l.problem.dofs().defect(l.state, .1, held);
  const auto b = l.system.right_hand_side(l.problem.residual(l.state), held);
  const LinearReport report = solver.solve(l.system, b, x, 1e-6);
  EXPECT_TRUE(report.ok) << report.reason;
  l.system.apply(x, Ax);
  const auto& s = l.system.scaling();
  double left = 0, all = 0;
  for (std::size_t i = 0; i < b.size(); ++i)
    left += std::pow(s[i] * (b[i] - Ax[i]), 2), all += std::pow(s[i] * b[i], 2);
  EXPECT_LT(std::sqrt(left / all), 2e-6);
  return report;
}

// The first time zonules become taut, which are much of their neighbourhood's stiffness.
void widen(Linearised& l, double part = .01) {
  for (double& x : l.state.x) x *= 1 + part;
  l.system.linearize(l.state, l.problem.residual(l.state));
}

// Iterations of a solve, and what its set-up took from the one before.
struct Solved {
  int iterations;
  SetUp how;
};

// A solve a little way off, by what was set up before or for it.
Solved solved_after(Linearised& l, double reuse, double coarse_change) {
  widen(l);
  l.settings.reuse = reuse;
  l.settings.coarse_change = coarse_change;
  Profiler profiler;
  std::vector<SetUp> set_ups;
  const auto recorded = [&, make = make_preconditioner_factory(l.settings, profiler)](CoupledSystem& system,
                                                                                      SetUp wanted) {
    MadePreconditioner made = make(system, wanted);
    set_ups.push_back(made.how);
    return made;
  };
  const auto solver = make_krylov_solver(l.settings, recorded, profiler);
  solve(l, *solver);
  widen(l);
  const int iterations = solve(l, *solver).iterations;
  EXPECT_EQ(set_ups.size(), 2u);
  EXPECT_EQ(set_ups.front(), SetUp::anew);
  return {iterations, set_ups.back()};
}

Solved unrefined_solved_after(double reuse, double coarse_change) {
  Linearised l(small_eye(8), 0, 0);
  return solved_after(l, reuse, coarse_change);
}

TEST(Reuse, SolvesThePresentSystemWithAnEarlierPreconditioner) {
  const Solved own = unrefined_solved_after(0, 0), kept = unrefined_solved_after(2, 0);
  EXPECT_EQ(own.how, SetUp::anew);
  EXPECT_EQ(kept.how, SetUp::kept);
  EXPECT_LE(kept.iterations, 1.5 * own.iterations);
}

TEST(Reuse, SolvesThePresentSystemWithEarlierCoarseFactors) {
  const Solved own = unrefined_solved_after(0, 0), kept = unrefined_solved_after(0, .5);
  EXPECT_EQ(own.how, SetUp::anew);
  EXPECT_EQ(kept.how, SetUp::factors_kept);
  EXPECT_LE(kept.iterations, own.iterations + 1);
}

// Of a refined mesh with an enclosed liquid: base factors, largest eigenvalues, weak patterns and the
// liquid's column.
TEST(Reuse, SolvesThePresentCoupledSystemWithEarlierParts) {
  const auto solved = [](double coarse_change) {
    Linearised l(small_eye(4), 1, 0);
    l.problem.end_step();
    l.problem.begin_step(1, l.state);
    return solved_after(l, 0, coarse_change);
  };
  const Solved own = solved(0), kept = solved(.5);
  EXPECT_EQ(own.how, SetUp::anew);
  EXPECT_EQ(kept.how, SetUp::factors_kept);
  EXPECT_LE(kept.iterations, own.iterations + 1);
}

TEST(Reuse, KeepsCoarseFactorsWhileTheirMatrixHardlyChanges) {
  for (int refinements : {0, 1}) {
    Linearised l(small_eye(4), refinements, 0);
    widen(l);
    Profiler profiler;
    const auto make = make_preconditioner_factory(l.settings, profiler);
    EXPECT_EQ(make(l.system, SetUp::factors_kept).how, SetUp::anew);  // there are none yet
    EXPECT_EQ(make(l.system, SetUp::factors_kept).how, SetUp::factors_kept);
    EXPECT_EQ(make(l.system, SetUp::anew).how, SetUp::anew);
    widen(l, .001);
    EXPECT_EQ(make(l.system, SetUp::factors_kept).how, SetUp::factors_kept);
    widen(l, .3);
    EXPECT_EQ(make(l.system, SetUp::factors_kept).how, SetUp::anew);
  }
}

TEST(Reuse, KeepsOnlyWhatFits) {
  Linearised l(small_eye(8), 0, 0);
  Profiler profiler;
  const auto make = make_preconditioner_factory(l.settings, profiler);
  EXPECT_EQ(make(l.system, SetUp::kept).how, SetUp::anew);  // there is none yet
  EXPECT_EQ(make(l.system, SetUp::kept).how, SetUp::kept);
  widen(l);
  EXPECT_EQ(make(l.system, SetUp::kept).how, SetUp::kept);
  EXPECT_EQ(make(l.system, SetUp::anew).how, SetUp::anew);
}

}  // namespace
}  // namespace bulbus
