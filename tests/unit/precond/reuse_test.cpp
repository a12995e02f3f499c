#include "precond/make_preconditioner.hpp"
#include "precond/preconditioner_cache.hpp"
#include "tests/support/linearised.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

// Solves the present Newton step to 1e-6 in the norm of the solver.
LinearReport solve(Linearised& l, LinearSolver& solver) {
  const Preparation prepared = solver.prepare(l.system);
  EXPECT_TRUE(prepared.ok);
  const CoupledOperator A(l.system, prepared.augmentation);
  std::vector<double> prescribed(l.state.x.size()), x(l.system->size()), Ax(x);
  l.problem.dofs().prescribed_increment(l.state, .1, prescribed);
  const auto b = A.right_hand_side(l.problem.residual(l.state), prescribed);
  const LinearReport report = solver.solve(A, b, x, 1e-6);
  EXPECT_TRUE(report.ok) << report.reason;
  A.apply(x, Ax);
  const auto& s = l.system->scaling();
  double left = 0, all = 0;
  for (std::size_t i = 0; i < b.size(); ++i)
    left += std::pow(s[i] * (b[i] - Ax[i]), 2), all += std::pow(s[i] * b[i], 2);
  EXPECT_LT(std::sqrt(left / all), 2e-6);
  return report;
}

// The first time zonules become taut, which are much of their neighbourhood's stiffness.
void widen(Linearised& l, double part = .01) {
  for (double& x : l.state.x) x *= 1 + part;
  l.linearise();
}

// Iterations of a solve, and what its preconditioner took over from the one before.
struct Solved {
  int iterations;
  Reuse reused;
};

// A solve a little way off, by what was set up before or for it.
Solved solved_after(Linearised& l, double reuse, double coarse_change) {
  widen(l);
  l.settings.reuse = reuse;
  l.settings.coarse_change = coarse_change;
  Profiler profiler;
  auto factory = std::make_unique<PreconditionerCache>(l.settings, profiler);
  const PreconditionerCache& cache = *factory;
  const auto solver = make_krylov_solver(l.settings, std::move(factory), profiler);
  solve(l, *solver);
  EXPECT_EQ(cache.reused(), Reuse{});
  widen(l);
  const int iterations = solve(l, *solver).iterations;
  return {iterations, cache.reused()};
}

Solved unrefined_solved_after(double reuse, double coarse_change) {
  Linearised l(small_eye(8), 0, 0);
  return solved_after(l, reuse, coarse_change);
}

TEST(Reuse, SolvesThePresentSystemWithAnEarlierPreconditioner) {
  const Solved own = unrefined_solved_after(0, 0), kept = unrefined_solved_after(2, 0);
  EXPECT_EQ(own.reused, Reuse{});
  EXPECT_EQ(kept.reused, (Reuse{.displacement = true, .coarse_factors = true, .corrections = true}));
  EXPECT_LE(kept.iterations, 1.5 * own.iterations);
}

TEST(Reuse, SolvesThePresentSystemWithEarlierCoarseFactors) {
  const Solved own = unrefined_solved_after(0, 0), kept = unrefined_solved_after(0, .5);
  EXPECT_EQ(own.reused, Reuse{});
  EXPECT_EQ(kept.reused, (Reuse{.coarse_factors = true}));
  EXPECT_LE(kept.iterations, own.iterations + 1);
}

// Of a refined mesh with an enclosed liquid: base factors, largest eigenvalues, corrections and the
// liquid's column.
TEST(Reuse, SolvesThePresentCoupledSystemWithEarlierParts) {
  const auto solved = [](double coarse_change) {
    Linearised l(small_eye(4), 1, 0);
    l.problem.end_step();
    l.problem.begin_step(1, l.state);
    return solved_after(l, 0, coarse_change);
  };
  const Solved own = solved(0), kept = solved(.5);
  EXPECT_EQ(own.reused, Reuse{});
  EXPECT_EQ(kept.reused, (Reuse{.coarse_factors = true, .corrections = true}));
  EXPECT_LE(kept.iterations, own.iterations + 1);
}

// Its memory is that of the next one.
TEST(Reuse, OfAReleasedLinearisationNothingIsLeft) {
  for (auto [displacement, refinements] : {std::pair{Displacement::aggregation, 0},
                                           {Displacement::hybrid, 0},
                                           {Displacement::multigrid, 1},
                                           {Displacement::multigrid, 2}})
    for (Precision smoothing : {Precision::full, Precision::single}) {
      Linearised l(stretched_block(2, ".1"), refinements, 0);
      l.settings.displacement = displacement;
      l.settings.smoothing = smoothing;
      Profiler profiler;
      PreconditionerCache cache(l.settings, profiler);
      {
        const auto M = cache.make(l.system);
        if (M->has_deferred_component()) M->enable_deferred_component(1e-6);
      }
      const std::weak_ptr<const CoupledSystem> kept = l.system;
      l.system.reset();
      EXPECT_FALSE(kept.expired()) << "it may be taken over";
      cache.release();
      EXPECT_TRUE(kept.expired()) << word_of(displacement) << " " << refinements;
    }
}

// What the next preconditioner takes over; its solve is easy.
Reuse reused(PreconditionerCache& cache, const SharedSystem& system) {
  cache.make(system);
  cache.record(1);
  return cache.reused();
}

TEST(Reuse, KeepsCoarseFactorsWhileTheirMatrixHardlyChanges) {
  for (int refinements : {0, 1}) {
    Linearised l(small_eye(4), refinements, 0);
    widen(l);
    Profiler profiler;
    PreconditionerCache cache(l.settings, profiler);
    const Reuse factors{.coarse_factors = true, .corrections = refinements > 0};
    EXPECT_EQ(reused(cache, l.system), Reuse{});  // there are none yet
    EXPECT_EQ(reused(cache, l.system), factors);
    cache.forget();
    EXPECT_EQ(reused(cache, l.system), Reuse{});
    widen(l, .001);
    EXPECT_EQ(reused(cache, l.system), factors);
    widen(l, .3);
    EXPECT_EQ(reused(cache, l.system), Reuse{});
  }
}

TEST(Reuse, KeepsOnlyWhatFits) {
  Linearised l(small_eye(8), 0, 0);
  Profiler profiler;
  l.settings.reuse = 1;
  PreconditionerCache cache(l.settings, profiler);
  const Reuse all{.displacement = true, .coarse_factors = true, .corrections = true};
  EXPECT_EQ(reused(cache, l.system), Reuse{});  // there is none yet
  EXPECT_EQ(reused(cache, l.system), all);
  widen(l);
  EXPECT_EQ(reused(cache, l.system), all);
  cache.forget();
  EXPECT_EQ(reused(cache, l.system), Reuse{});
}

std::vector<double> preconditioned(const Preconditioner& M) {
  const auto b = noise_vector(M.size(), 3);
  std::vector<double> x(b.size());
  M.apply(b, x);
  return x;
}

// A failed solve asks first for all made anew, then for factors in place of levels, then for nothing more.
TEST(Reuse, EndsInFactorsOfTheCoarseMatrix) {
  Linearised l(small_eye(6), 0, 0);
  widen(l);
  l.settings.aggregation.factorised = 100;
  Profiler profiler;
  PreconditionerCache cache(l.settings, profiler);
  EXPECT_FALSE(cache.can_improve()) << "nothing is made";
  auto preconditioner = cache.make(l.system);
  cache.record(1);
  ASSERT_TRUE(cache.can_improve());
  cache.improve();
  preconditioner.reset();
  preconditioner = cache.make(l.system);
  const auto levels = preconditioned(*preconditioner);
  ASSERT_TRUE(cache.can_improve()) << "there are levels";
  cache.improve();
  preconditioner.reset();
  preconditioner = cache.make(l.system);
  EXPECT_FALSE(cache.can_improve());
  l.settings.aggregation.factorised = 1000000;
  PreconditionerCache factorised(l.settings, profiler);
  const auto wanted = preconditioned(*factorised.make(l.system)), found = preconditioned(*preconditioner);
  EXPECT_LT(relative_difference(found, wanted), 1e-6);
  EXPECT_GT(relative_difference(levels, wanted), 1e-4) << "levels approximate";
}

}  // namespace
}  // namespace bulbus
