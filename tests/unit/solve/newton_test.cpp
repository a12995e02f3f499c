#include "core/solve/newton.hpp"

#include <gtest/gtest.h>

#include "tests/support/two_regions.hpp"
#include "tests/unit/solve/trial.hpp"

namespace bulbus {
namespace {

using namespace test;

/// Fails until it is prepared once more, as a solver may that takes over parts of its preconditioner.
struct Reusing final : LinearSolver {
  std::unique_ptr<LinearSolver> inner;
  int preparations = 0;
  explicit Reusing(std::unique_ptr<LinearSolver> solver) : inner(std::move(solver)) {}
  Preparation prepare(SharedSystem system) override {
    ++preparations;
    return inner->prepare(std::move(system));
  }
  LinearReport solve(const CoupledOperator& A, std::vector<double> b, std::span<double> x,
                     double tolerance) override {
    if (preparations == 1) return {.reason = "old", .retry = true, .iterations = 7};
    return inner->solve(A, b, x, tolerance);
  }
};

TEST(Newton, SolvesAgainWithANewPreconditionerWhereAnOldOneFails) {
  Trial t(stretched_block(2, "0.4"));
  t.settings.linear.gamma = 0;
  Reusing solver(make_direct_solver(t.settings.linear, t.profiler));
  t.problem.begin_step(0, t.state);
  const NewtonReport r =
      newton(t.problem, t.settings.linear, solver, t.state, 1, t.settings.newton, t.profiler, {});
  EXPECT_EQ(r.outcome, Outcome::converged) << r.reason;
  EXPECT_EQ(solver.preparations, 1 + static_cast<int>(r.iterations.size()));
  EXPECT_EQ(r.krylov_iterations, 7);  // what was spent is counted
}

TEST(Newton, NothingToDoTakesNoIteration) {
  const Scene scene = stretched_block(2, "0");
  const Comm comm;
  Problem problem(scene.mesh, scene.model, comm);
  State state = problem.initial_state();
  problem.begin_step(0, state);
  Profiler profiler;
  const auto solver = make_direct_solver({}, profiler);
  int seen = 0;
  const NewtonReport r =
      newton(problem, {}, *solver, state, 1, {}, profiler, [&](const NewtonIteration&) { ++seen; });
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
  Profiler profiler;
  const auto solver = make_direct_solver({}, profiler);
  EXPECT_EQ(newton(problem, {}, *solver, state, 1, {}, profiler).outcome, Outcome::not_finite);
}

TEST(Newton, NotANumberIsNoticedInEveryRegionAndLiquid) {
  const auto outcome = [](const Scene& scene, const std::function<void(Problem&, State&)>& spoil) {
    Problem problem(scene.mesh, scene.model, Comm());
    State state = problem.initial_state();
    problem.begin_step(0, state);
    spoil(problem, state);
    Profiler profiler;
    const auto solver = make_direct_solver({}, profiler);
    return newton(problem, {}, *solver, state, 1, {}, profiler).outcome;
  };
  for (int hex = 0; hex < 4; ++hex)
    EXPECT_EQ(outcome(two_regions(),
                      [&](const Problem& problem, State& state) {
                        for (std::size_t h = 0; h < state.lambda.size(); ++h)
                          if (problem.mesh().input_hex[h] == hex) state.lambda[h] = NAN;
                      }),
              Outcome::not_finite)
        << hex;
  Problem problem(filled_shell("octant").mesh, filled_shell("octant").model, Comm());
  Residual r = problem.residual(problem.initial_state());
  ASSERT_FALSE(r.liquid.empty());
  r.liquid[0] = NAN;
  EXPECT_TRUE(std::isinf(problem.equilibrium_error(r).liquid));
}

TEST(Newton, EveryOutcomeHasWords) {
  for (Outcome o : {Outcome::converged, Outcome::inverted_element, Outcome::linear_solver_failed,
                    Outcome::too_many_iterations, Outcome::cycling, Outcome::not_finite})
    EXPECT_FALSE(describe(o).empty());
}

}  // namespace
}  // namespace bulbus
