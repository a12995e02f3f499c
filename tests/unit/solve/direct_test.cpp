// Every direct solver by its name in the settings, against MUMPS.
#include <gtest/gtest.h>

#include "core/solve/direct/libraries.hpp"
#include "core/solve/direct/make_factorisation.hpp"
#include "core/solve/direct/system_factors.hpp"
#include "core/solve/direct_fallback.hpp"
#include "tests/support/models.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/refusal.hpp"

namespace bulbus {
namespace {

LinearSettings direct_settings(Direct library) {
  return {.method = Method::direct, .direct = library, .op = TangentStorage::recompute, .gamma = 0};
}

std::vector<Direct> libraries() {
  std::vector<Direct> all{Direct::mumps, Direct::superlu_dist, Direct::eigen};
  if (has_umfpack()) all.push_back(Direct::umfpack);
  return all;
}

// A shell octant full of liquid at 0.05 MPa, shaken: every kind of unknown.
struct DirectTest : testing::Test {
  Comm comm;
  Profiler profiler;
  Scene scene = filled_shell("octant");
  Problem problem{scene.mesh, scene.model, comm};
  State state = problem.initial_state();
  SharedSystem system;
  std::vector<double> b;

  void SetUp() override {
    problem.begin_step(0, state), problem.set_progress(1, state), problem.end_step();
    state = shaken(problem, state, .02, 3);
    problem.begin_step(1, state);
    const Residual r = problem.residual(state);
    system = std::make_shared<const CoupledSystem>(problem, direct_settings(Direct::mumps), state, r);
    std::vector<double> prescribed(state.x.size());
    b = CoupledOperator(system).right_hand_side(r, prescribed);
  }
  std::vector<double> solved_by(const LinearSettings& settings, double tolerance = 1e-6) {
    std::vector<double> x(b.size(), NAN);
    auto solver = make_direct_solver(settings, profiler);
    const Preparation prepared = solver->prepare(system);
    EXPECT_TRUE(prepared.ok) << prepared.reason;
    if (!prepared.ok) return x;
    const LinearReport report = solver->solve(CoupledOperator(system), b, x, tolerance);
    EXPECT_TRUE(report.ok) << report.reason;
    iterations = report.iterations;
    return x;
  }
  int iterations = 0;
};

TEST_F(DirectTest, AllGiveTheSolutionOfMumps) {
  const std::vector<double> x = solved_by(direct_settings(Direct::mumps));
  for (Direct library : not_empty(libraries()))
    EXPECT_LT(relative_difference(solved_by(direct_settings(library)), x), 1e-10) << word_of(library);
}

TEST_F(DirectTest, OfOneMatrixAfterTheOther) {
  for (Direct library : not_empty(libraries())) {
    SystemFactors factors(direct_settings(library), profiler);
    std::vector<double> first(b.size()), second(b.size());
    for (std::vector<double>* x : {&first, &second}) {
      const FactorReport report = factors.factorise(system);
      ASSERT_TRUE(report.ok) << word_of(library) << ": " << report.reason;
      EXPECT_GT(report.factor_entries, report.matrix_entries) << word_of(library);
      EXPECT_GT(report.memory_mb, 0) << word_of(library);
      ASSERT_TRUE(factors.solve(b, *x));
    }
    EXPECT_LT(relative_difference(second, first), 1e-12) << word_of(library);
  }
}

TEST_F(DirectTest, OnlyMumpsCountsPivots) {
  for (Direct library : not_empty(libraries())) {
    auto solver = make_direct_solver(direct_settings(library), profiler);
    EXPECT_EQ(solver->prepare(system).negative_pivots >= 0, library == Direct::mumps) << word_of(library);
  }
}

TEST_F(DirectTest, UnsymmetricAndSingularMatrices) {
  constexpr int n = 40;
  Triplets t;
  std::vector<double> wanted(n), c(n, 0.);
  for (int i = 0; i < n; ++i) {
    wanted[i] = std::sin(i + 1);
    for (int j : {i - 1, i, i + 1})
      if (j >= 0 && j < n)
        t.row.push_back(i), t.col.push_back(j), t.value.push_back(i == j ? 3 : .2 * (j - i) - 1);
  }
  for (std::size_t k = 0; k < t.row.size(); ++k) c[t.row[k]] += t.value[k] * wanted[t.col[k]];
  Triplets singular = t;
  for (std::size_t k = 0; k < t.row.size(); ++k)
    if (t.row[k] == 7 || t.col[k] == 7) singular.value[k] = 0;
  for (Direct library : not_empty(libraries())) {
    auto factors = make_factorisation(direct_settings(library), comm, 0);
    std::vector<double> x(n, NAN);
    ASSERT_TRUE(factors->factorise(t, n, false).ok) << word_of(library);
    ASSERT_TRUE(factors->solve(c, x)) << word_of(library);
    EXPECT_LT(relative_difference(x, wanted), 1e-12) << word_of(library);
    const FactorReport report = factors->factorise(singular, n, false);
    const bool told = !report.ok || report.null_pivots == 1;
    EXPECT_TRUE(told || !factors->solve(c, x)) << word_of(library);
    if (library != Direct::superlu_dist) {
      EXPECT_TRUE(told) << word_of(library);
    }
  }
}

TEST_F(DirectTest, FactorsPreconditionGmres) {
  const std::vector<double> x = solved_by(direct_settings(Direct::mumps));
  for (Direct library : not_empty(libraries())) {
    LinearSettings settings = direct_settings(library);
    settings.refinement = Refinement::gmres;
    EXPECT_LT(relative_difference(solved_by(settings, 1e-11), x), 1e-8) << word_of(library);
    EXPECT_GE(iterations, 1) << word_of(library);
    EXPECT_LE(iterations, library == Direct::superlu_dist ? 10 : 3)
        << word_of(library);  // it exchanges no pivots
  }
}

TEST_F(DirectTest, RefusesWhatALibraryCannotDo) {
  for (Direct library : {Direct::eigen, Direct::umfpack}) {
    test::expect_refusal([&] { check_direct(direct_settings(library), 2); }, {"on one rank", "Choose mumps"});
    LinearSettings unused = direct_settings(library);
    unused.method = Method::iterative;
    EXPECT_NO_THROW(check_direct(unused, 2));
  }
  EXPECT_NO_THROW(check_direct(direct_settings(Direct::superlu_dist), 2));
  const auto on_one = [] { check_direct(direct_settings(Direct::umfpack), 1); };
  if (has_umfpack())
    EXPECT_NO_THROW(on_one());
  else
    test::expect_refusal(on_one, {"not part of this build", "-DBULBUS_UMFPACK=ON"});
  for (Direct library : not_empty(libraries())) {
    LinearSettings small = direct_settings(library);
    small.memory_limit = 1e-3;
    SystemFactors factors(small, profiler);
    const FactorReport report = factors.factorise(system);
    EXPECT_TRUE(report.too_large) << word_of(library);
    EXPECT_NE(report.reason.find("MB allowed"), std::string::npos) << report.reason;
    EXPECT_FALSE(factors.solve(b, b));
  }
}

TEST_F(DirectTest, EigenIsForSmallSystems) {
  scene = stretched_block(18, ".1");
  Problem large(scene.mesh, scene.model, comm);
  const State start = large.initial_state();
  const auto big = std::make_shared<const CoupledSystem>(large, direct_settings(Direct::eigen), start,
                                                         large.residual(start));
  SystemFactors factors(direct_settings(Direct::eigen), profiler);
  const FactorReport report = factors.factorise(big);
  EXPECT_TRUE(report.too_large);
  EXPECT_NE(report.reason.find("more than 20000 take too long"), std::string::npos) << report.reason;
}

// What the regularisation leaves grows with γ in the norm of the augmented system, and is refined away.
TEST_F(DirectTest, AugmentationMakesNoMatrixSingular) {
  LinearSettings settings = direct_settings(Direct::mumps);
  settings.gamma = 1e4;
  const Residual r = problem.residual(state);
  system = std::make_shared<const CoupledSystem>(problem, settings, state, r);
  const CoupledOperator A(system);
  std::vector<double> prescribed(state.x.size()), x(system->size(), NAN);
  b = A.right_hand_side(r, prescribed);
  for (double tolerance : {.5, 1e-3}) {
    const LinearReport report = DirectFallback(settings, profiler).solve(A, b, x, tolerance);
    EXPECT_TRUE(report.ok) << report.reason;
    EXPECT_LT(report.reduction, 1e-6);
  }
  EXPECT_LT(relative_difference(solved_by(settings), x), 1e-6);
}

}  // namespace
}  // namespace bulbus
