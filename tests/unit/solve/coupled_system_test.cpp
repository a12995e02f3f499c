#include "core/solve/coupled_operator.hpp"

#include <gtest/gtest.h>

#include "core/solve/assemble.hpp"
#include "core/solve/linear_solver.hpp"
#include "tests/support/gathered.hpp"
#include "tests/support/models.hpp"

namespace bulbus {
namespace {

/// A coupled system in a random state of a liquid-filled shell, with held increments still to be made.
struct System {
  Comm comm;
  Scene scene;
  Problem problem;
  State state;
  Residual residual;
  SharedSystem system;
  LiquidAugmentation augmentation;

  System(const std::string& part, double gamma, double omega, TangentStorage op = TangentStorage::recompute,
         Formulation formulation = Formulation::bordered)
      : scene(filled_shell(part)),
        problem(scene.mesh, scene.model, comm),
        state(problem.initial_state()),
        augmentation{{omega}} {
    problem.begin_step(0, state);
    problem.set_progress(1, state);
    state = shaken(problem, state, .02, 3);
    problem.end_step();
    problem.begin_step(1, state);
    state.P[0] = .3;
    residual = problem.residual(state);
    system = std::make_shared<const CoupledSystem>(
        problem, LinearSettings{.formulation = formulation, .op = op, .gamma = gamma}, state, residual);
  }
  std::vector<double> noise_unknowns(int seed) const {
    auto v = noise_primal(problem, seed);
    for (double l : noise_lambda(problem, seed)) v.push_back(l);
    for (int i = 0; i < system->layout().liquids; ++i) v.push_back(noise(seed + 3, i));
    return v;
  }
  std::vector<double> apply(std::span<const double> x) const {
    std::vector<double> y(x.size(), NAN);
    op().apply(x, y);
    return y;
  }
  CoupledOperator op() const { return CoupledOperator(system, augmentation); }
  Eigen::MatrixXd matrix(bool augmented) const {
    return gathered(augmented ? assemble(op()) : assemble_plain(*system), global_size(system->problem()),
                    comm);
  }
  double difference(std::span<const double> a, std::span<const double> b) const {
    return (gathered(a, comm) - gathered(b, comm)).lpNorm<Eigen::Infinity>() /
           gathered(b, comm).lpNorm<Eigen::Infinity>();
  }
};

struct CoupledSystemTest : testing::TestWithParam<const char*> {};

TEST_P(CoupledSystemTest, AppliesWhatItAssembles) {
  for (auto [gamma, omega] : {std::pair{0.0, 0.0}, {10.0, 0.0}, {10.0, .04}}) {
    const System s(GetParam(), gamma, omega);
    const auto x = s.noise_unknowns(20);
    const Eigen::VectorXd y = gathered(s.apply(x), s.comm), expected = s.matrix(true) * gathered(x, s.comm);
    EXPECT_LT((y - expected).lpNorm<Eigen::Infinity>(), 1e-12 * expected.lpNorm<Eigen::Infinity>())
        << gamma << ' ' << omega;
  }
}

TEST_P(CoupledSystemTest, EveryKindOfTangentAppliesAlike) {
  const System exact(GetParam(), 10, .04), cached(GetParam(), 10, .04, TangentStorage::cache),
      assembled(GetParam(), 10, .04, TangentStorage::assembled);
  const auto x = exact.noise_unknowns(20), y = exact.apply(x);
  EXPECT_LT(exact.difference(cached.apply(x), y), 1e-6);
  EXPECT_LT(exact.difference(assembled.apply(x), y), 1e-12);
}

// Without augmentation the system is the derivative of the residual along the free directions.
TEST_P(CoupledSystemTest, IsDerivativeOfTheResidual) {
  System s(GetParam(), 0, 0);
  const Layout layout = s.system->layout();
  auto x = s.noise_unknowns(21);
  // free directions only, expressed as unknowns: held parts of x do not move anything
  const auto at = [&](double h) {
    State t = moved(s.problem, s.state, layout.primal(std::span<const double>(x)), h);
    for (int e = 0; e < layout.hexes; ++e) t.lambda[e] += h * x[layout.primal() + e];
    std::vector<double> dP(1);
    if (layout.liquids > 0) dP[0] = x.back();
    s.comm.broadcast(dP);
    t.P[0] += h * dP[0];
    const Residual r = s.problem.residual(t);
    std::vector<double> all = reduced(s.problem, t, r.force);
    all.insert(all.end(), r.volume.begin(), r.volume.end());
    if (layout.liquids > 0) all.push_back(-r.liquid[0]);
    return all;
  };
  const std::vector<double> zero(1), one{1};
  auto expected = derivative([&](std::span<const double> t) { return at(t[0]); }, zero, one, 1e-4);
  auto y = s.apply(x);
  // constrained directions are identity rows of the system; compare free ones
  std::vector<double> free(s.state.x.size());
  std::copy_n(y.begin(), layout.nodal, free.begin());
  s.problem.dofs().project(free);
  std::copy_n(free.begin(), layout.nodal, y.begin());
  // hexahedra of rigid regions have no volume equation
  for (int e = 0; e < layout.hexes; ++e)
    if (expected[layout.primal() + e] == 0) y[layout.primal() + e] = 0;
  // spin rows are symmetrised: half of spin × moment is left out (zero at equilibrium)
  const auto moment = s.problem.dofs().bodies_part(reduced(s.problem, s.state, s.residual.force));
  const auto q = s.problem.dofs().bodies_part(layout.primal(std::span<const double>(x)));
  for (int b = 0; 6 * b < layout.bodies; ++b) {
    const auto& is_free = s.problem.dofs().bodies()[b].free();
    Vec3<double> w, M;
    for (int i = 0; i < 3; ++i) w[i] = is_free[3 + i] ? q[6 * b + 3 + i] : 0, M[i] = moment[6 * b + 3 + i];
    const Vec3<double> half = cross(w, M);
    for (int i = 0; i < 3; ++i) expected[layout.nodal + 6 * b + 3 + i] -= is_free[3 + i] ? half[i] / 2 : 0;
    for (int i = 0; i < 6; ++i)
      if (!is_free[i]) y[layout.nodal + 6 * b + i] = 0;
  }
  EXPECT_LT(s.difference(y, expected), 1e-8);
}

// On the free unknowns; P ∂g/∂u of a cavity that symmetry planes close is symmetric too.
TEST_P(CoupledSystemTest, IsSymmetric) {
  const System s(GetParam(), 10, 0);
  EXPECT_TRUE(s.problem.symmetric());
  const Eigen::MatrixXd A = s.matrix(true);
  EXPECT_LT((A - A.transpose()).lpNorm<Eigen::Infinity>(), 1e-11 * A.lpNorm<Eigen::Infinity>());
}

TEST_P(CoupledSystemTest, StaysWhatItIsWhileAnotherIsMade) {
  System s(GetParam(), 10, .02, TangentStorage::cache);
  const auto x = s.noise_unknowns(1);
  const auto y = s.apply(x);
  State other = shaken(s.problem, s.state, .01, 9);
  other.P[0] = .1;
  const CoupledSystem next(s.problem, LinearSettings{.gamma = 10}, other, s.problem.residual(other));
  EXPECT_EQ(s.apply(x), y);
}

TEST_P(CoupledSystemTest, HeldRowsAreIdentityRows) {
  const System s(GetParam(), 10, .04);
  const DofMap& dofs = s.problem.dofs();
  auto x = s.noise_unknowns(22);
  const auto y = s.apply(x);
  std::vector<double> dx(s.state.x.size());
  dofs.expand(s.state, s.system->layout().primal(std::span<const double>(x)), dx);
  for (int n = 0; n < s.problem.mesh().owned; ++n) {
    if (!dofs.constrained(n)) continue;
    const Mat3<double> P = dofs.projector(n);
    for (int i = 0; i < 3; ++i) {
      double held_y = y[3 * n + i], held_x = x[3 * n + i];
      for (int j = 0; j < 3; ++j) held_y -= P(i, j) * y[3 * n + j], held_x -= P(i, j) * x[3 * n + j];
      EXPECT_NEAR(held_y, s.system->constrained_diagonal() * held_x, 1e-11);
    }
  }
}

// Augmentation belongs to the linear system only: the increments stay the same, prescribed ones included.
TEST_P(CoupledSystemTest, AugmentationDoesNotChangeTheSolution) {
  const auto solution = [&](double gamma, double omega, bool augmented) {
    System s(GetParam(), gamma, omega);
    std::vector<double> prescribed(s.state.x.size());
    EXPECT_GT(s.problem.dofs().prescribed_increment(s.state, .7, prescribed), 1e-3);
    const Eigen::VectorXd b = gathered(s.op().right_hand_side(s.residual, prescribed), s.comm);
    return Eigen::VectorXd(s.matrix(augmented).fullPivLu().solve(b));
  };
  const Eigen::VectorXd plain = solution(0, 0, false), augmented = solution(10, .04, true),
                        by_elements = solution(10, 0, true);
  EXPECT_LT(largest(std::span(plain.data(), plain.size())), 1e3);
  EXPECT_LT((augmented - plain).lpNorm<Eigen::Infinity>(), 1e-9 * plain.lpNorm<Eigen::Infinity>());
  EXPECT_LT((by_elements - plain).lpNorm<Eigen::Infinity>(), 1e-9 * plain.lpNorm<Eigen::Infinity>());
}

System eliminated(const char* part, double gamma) {
  return System(part, gamma, 0, TangentStorage::recompute, Formulation::eliminated);
}

TEST_P(CoupledSystemTest, EliminatedSystemAppliesWhatItAssemblesAndIsSymmetric) {
  const System s = eliminated(GetParam(), 10);
  const auto x = s.noise_unknowns(20);
  const Eigen::MatrixXd A = s.matrix(true);
  const Eigen::VectorXd y = gathered(s.apply(x), s.comm), expected = A * gathered(x, s.comm);
  EXPECT_LT((y - expected).lpNorm<Eigen::Infinity>(), 1e-12 * expected.lpNorm<Eigen::Infinity>());
  EXPECT_LT((A - A.transpose()).lpNorm<Eigen::Infinity>(), 1e-11 * A.lpNorm<Eigen::Infinity>());
}

// The same increments of displacements, element pressures and liquid, prescribed increments included.
TEST_P(CoupledSystemTest, EliminationDoesNotChangeTheSolution) {
  const auto increments = [](const System& s) {
    std::vector<double> prescribed(s.state.x.size());
    s.problem.dofs().prescribed_increment(s.state, .7, prescribed);
    const Eigen::VectorXd all =
        s.matrix(true).fullPivLu().solve(gathered(s.op().right_hand_side(s.residual, prescribed), s.comm));
    const long first = s.comm.offset(static_cast<long long>(s.system->size()));
    std::vector<double> mine(all.data() + first, all.data() + first + s.system->size());
    const double dP = s.op().pressure_increments(mine)[0];
    if (s.system->layout().liquids > 0) mine.back() = dP;
    return mine;
  };
  const System bordered(GetParam(), 0, 0);
  const auto expected = increments(bordered);
  for (double gamma : {0., 10.})
    EXPECT_LT(bordered.difference(increments(eliminated(GetParam(), gamma)), expected), 1e-9) << gamma;
}

// γ is part of system and right-hand side alike.
TEST_P(CoupledSystemTest, DirectSolverSolvesTheSystem) {
  System s(GetParam(), 10, 0);
  std::vector<double> prescribed(s.state.x.size()), x(s.system->size());
  s.problem.dofs().prescribed_increment(s.state, .7, prescribed);
  const auto b = s.op().right_hand_side(s.residual, prescribed);
  Profiler profiler;
  const auto solver = make_direct_solver({}, profiler);
  ASSERT_TRUE(solver->prepare(s.system).ok);
  const LinearReport report = solver->solve(s.op(), b, x, 1e-12);
  EXPECT_TRUE(report.ok);
  EXPECT_LT(report.reduction, 1e-11);
  EXPECT_LT(s.difference(s.apply(x), b), 1e-10);
}

// x + held solves the linearised equations: residual + derivative along the whole increment vanishes on free
// directions.
TEST_P(CoupledSystemTest, SolutionWithHeldIncrementsSolvesTheLinearisedEquations) {
  System s(GetParam(), 10, .04);
  const Layout layout = s.system->layout();
  std::vector<double> prescribed(s.state.x.size());
  s.problem.dofs().prescribed_increment(s.state, .7, prescribed);
  const Eigen::VectorXd x =
      s.matrix(true).fullPivLu().solve(gathered(s.op().right_hand_side(s.residual, prescribed), s.comm));
  const long first = s.comm.offset(static_cast<long long>(layout.size()));
  const std::vector<double> mine(x.data() + first, x.data() + first + layout.size());
  std::vector<double> dx(s.state.x.size()), dP(1);
  s.problem.dofs().expand(s.state, layout.primal(std::span<const double>(mine)), dx);
  for (std::size_t i = 0; i < dx.size(); ++i) dx[i] += prescribed[i];
  if (layout.liquids > 0) dP[0] = mine.back();
  s.comm.broadcast(dP);
  const auto at = [&](double h) {
    State t = s.state;
    for (std::size_t i = 0; i < dx.size(); ++i) t.x[i] += h * dx[i];
    for (int e = 0; e < layout.hexes; ++e) t.lambda[e] += h * mine[layout.primal() + e];
    t.P[0] += h * dP[0];
    const Residual r = s.problem.residual(t);
    std::vector<double> f = r.force;
    s.problem.dofs().project(f);
    f.resize(layout.nodal);
    f.insert(f.end(), r.volume.begin(), r.volume.end());
    f.push_back(r.liquid[0]);
    return f;
  };
  const std::vector<double> zero(1), one{1};
  const auto change = derivative([&](std::span<const double> t) { return at(t[0]); }, zero, one, 1e-3);
  const auto sum = plus(change, 1, at(0));
  EXPECT_LT(s.comm.max(largest(sum)), 1e-6 * s.comm.max(largest(at(0))));
}

TEST_P(CoupledSystemTest, ScaledDiagonalIsAboutOne) {
  const System s(GetParam(), 10, .04);
  const Eigen::MatrixXd A = s.matrix(true);
  const Eigen::VectorXd scale = gathered(s.system->scaling(), s.comm);
  const long first = s.comm.offset(static_cast<long long>(s.system->size()));
  for (int i = 0; i < s.system->layout().primal(); ++i) {
    const double d = A(first + i, first + i) * scale[first + i] * scale[first + i];
    EXPECT_GT(d, .5) << i;
    EXPECT_LT(d, 3) << i;
  }
  for (long i = 0; i < scale.size(); ++i) EXPECT_TRUE(std::isfinite(scale[i]) && scale[i] > 0) << i;
}

TEST_P(CoupledSystemTest, NodalAndBodyBlocksAreTheMatrixs) {
  const System s(GetParam(), 10, 0);
  const Eigen::MatrixXd A = s.matrix(true);
  const long first = s.comm.offset(static_cast<long long>(s.system->size()));
  const double size = A.cwiseAbs().maxCoeff();
  const auto blocks = s.system->nodal_blocks();
  for (int n = 0; n < s.problem.mesh().owned; ++n)
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(blocks[9 * n + i], A(first + 3 * n + i / 3, first + 3 * n + i % 3), 1e-12 * size);
  for (int b = 0; 6 * b < s.system->layout().bodies; ++b)
    for (int i = 0; i < 36; ++i) {
      const long at = first + s.system->layout().nodal + 6 * b;
      EXPECT_NEAR(s.system->body_blocks()[b][i], A(at + i / 6, at + i % 6), 1e-12 * size);
    }
}

TEST_P(CoupledSystemTest, DisplacementActionIsTheFirstBlock) {
  const System s(GetParam(), 10, 0);
  const int primal = s.system->layout().primal();
  auto x = s.noise_unknowns(23);
  std::fill(x.begin() + primal, x.end(), 0.0);
  std::vector<double> y(primal, NAN);
  s.system->apply_displacement(std::span(x).first(primal), y);
  auto expected = s.apply(x);
  expected.resize(primal);
  EXPECT_LT(s.difference(y, expected), 1e-13);
}

TEST_P(CoupledSystemTest, PressureForceIsTheSecondColumn) {
  const System s(GetParam(), 10, .04);
  const Layout& layout = s.system->layout();
  auto x = s.noise_unknowns(24);
  std::fill_n(x.begin(), layout.primal(), 0.0);
  if (layout.liquids > 0) x.back() = 0;
  auto expected = s.apply(x);
  expected.resize(layout.primal());
  std::vector<double> y(layout.primal());
  s.system->add_pressure_force(layout.lambda(std::span<const double>(x)), -2, y);
  EXPECT_LT(s.difference(y, plus(std::vector<double>(y.size()), -2, expected)), 1e-13);
}

TEST_P(CoupledSystemTest, DisplacementMatrixIsTheNodalPartOfTheWhole) {
  const System s(GetParam(), 10, 0);
  const long long nodal = 3 * s.problem.mesh().all_nodes;
  const Eigen::MatrixXd K = gathered(assemble_displacement(*s.system), nodal, s.comm);
  // the nodal part of x is one run per rank here, with gaps there
  const int n = s.system->layout().nodal;
  auto x = s.noise_unknowns(25);
  std::fill(x.begin() + n, x.end(), 0.0);
  auto y = s.apply(x);
  y.resize(n), x.resize(n);
  const Eigen::VectorXd expected = gathered(y, s.comm), got = K * gathered(x, s.comm);
  EXPECT_LT((got - expected).lpNorm<Eigen::Infinity>(), 1e-12 * expected.lpNorm<Eigen::Infinity>());
}

INSTANTIATE_TEST_SUITE_P(FilledShell, CoupledSystemTest, testing::Values("octant", "half"),
                         [](const auto& info) { return std::string(info.param); });

TEST(CoupledSystem, GivenPressureKeepsItsRow) {
  const Comm comm;
  const Scene scene = filled_shell("octant");
  Problem problem(scene.mesh, scene.model, comm);
  State state = problem.initial_state();
  problem.begin_step(0, state);
  problem.set_progress(1, state);
  EXPECT_DOUBLE_EQ(state.P[0], .05);
  const Residual r = problem.residual(state);
  EXPECT_EQ(r.liquid[0], 0);
  const auto system = std::make_shared<const CoupledSystem>(
      problem, LinearSettings{.op = TangentStorage::recompute, .gamma = 10}, state, r);
  EXPECT_TRUE(system->liquid_columns()[0].empty());
  std::vector<double> x(system->size()), y(system->size(), NAN);
  if (system->layout().liquids > 0) x.back() = 2;
  CoupledOperator(system).apply(x, y);
  if (system->layout().liquids > 0) {
    EXPECT_DOUBLE_EQ(y.back(), -2 * system->compliance(0));
    y.pop_back();
  }
  EXPECT_EQ(largest(y), 0);
}

}  // namespace
}  // namespace bulbus
