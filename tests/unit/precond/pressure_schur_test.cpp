#include "precond/schur/pressure_schur.hpp"
#include "precond/schur/line_pressure_stiffness.hpp"
#include "precond/schur/oscillation_filter.hpp"

#include <random>

#include "tests/support/linearised.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

std::vector<double> noise(int size, int seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> v(size);
  for (double& x : v) x = uniform(random);
  return v;
}

double product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

constexpr double shake = .001;

TEST(LinePressureStiffness, IsTheProductOfItsFactors) {
  for (const Scene& scene : {thin_plate(), filled_shell("octant"), small_eye(8)}) {
    WithLines l(scene, 0, shake);
    const LinePressureStiffness K(l.system, l.jacobi);
    const auto p = noise(K.size(), 1);
    std::vector<double> force(l.system->layout().primal()), motion(force.size()), nodal(l.state.x.size()),
        expected(p.size()), found(p.size());
    l.system->add_pressure_force(p, 1, force);
    l.jacobi->apply(force, motion);
    std::fill(motion.begin() + l.system->layout().nodal, motion.end(), 0);
    l.problem.dofs().expand(l.state, motion, nodal);
    l.system->solid().volume_change(nodal, expected);
    K.apply(p, found);
    double scale = 0;
    for (double v : expected) scale = std::max(scale, std::abs(v));
    ASSERT_GT(scale, 0);
    for (std::size_t e = 0; e < p.size(); ++e) EXPECT_NEAR(found[e], expected[e], 1e-5 * scale) << e;
  }
}

TEST(PressureSchur, IsSymmetricAndPositive) {
  for (const auto& [scene, refine] :
       {std::pair(small_eye(8), 0), {filled_shell("half"), 1}, {filled_shell("octant"), 2}}) {
    WithLines l(scene, refine, shake);
    PressureSchur schur(l.system, l.jacobi, {}, std::make_shared<SchurCorrections>());
    schur.enable_deferred_component(1e-6);
    const auto p = noise(schur.size(), 1), q = noise(schur.size(), 2);
    std::vector<double> Sp(p.size()), Sq(p.size());
    schur.apply(p, Sp);
    schur.apply(q, Sq);
    EXPECT_GT(product(p, Sp), 0);
    EXPECT_NEAR(product(q, Sp), product(p, Sq), 1e-5 * product(p, Sp));
  }
}

TEST(PressureSchur, LeavesPressuresOfRigidHexahedraAlone) {
  for (int refine : {0, 1, 2}) {
    WithLines l(filled_shell("half"), refine, shake);
    PressureSchur schur(l.system, l.jacobi, {}, std::make_shared<SchurCorrections>());
    const auto p = noise(schur.size(), 1);
    std::vector<double> before(p.size()), after(p.size());
    schur.apply(p, before);
    schur.enable_deferred_component(1e-6);
    schur.apply(p, after);
    EXPECT_NE(before, after);
    ASSERT_FALSE(l.problem.solid().rigid_hexes().empty());
    for (int e : l.problem.solid().rigid_hexes()) EXPECT_EQ(after[e], before[e]);
  }
}

TEST(CarriedByLines, AFilmIsAndABulkIsNot) {
  for (const auto& [aspect, expected] : {std::pair(50., 256), {1., 0}}) {
    WithLines l(glued_slab(aspect, false), 0, shake);
    EXPECT_EQ(std::ranges::count(carried_by_lines(*l.system, *l.jacobi), 1), expected);
  }
}

TEST(PressureSchur, HoldsBackUntilItIsAsked) {
  WithLines l(small_eye(8), 0, shake);
  const auto corrections = std::make_shared<SchurCorrections>();
  PressureSchur schur(l.system, l.jacobi, {}, corrections);
  const auto p = noise(schur.size(), 1), diagonal = l.system->inverse_pressure_schur();
  std::vector<double> z(p.size());
  EXPECT_TRUE(schur.has_deferred_component());
  schur.apply(p, z);
  for (std::size_t e = 0; e < p.size(); ++e) EXPECT_EQ(z[e], diagonal[e] * p[e]);
  schur.enable_deferred_component(1e-6);
  EXPECT_FALSE(schur.has_deferred_component());
  EXPECT_FALSE(PressureSchur(l.system, nullptr, {}, corrections).has_deferred_component());
}

TEST(PressureSchur, MakesItsPartsAnewWhereMoreDigitsAreAskedFor) {
  WithLines l(filled_shell("half"), 0, shake);
  const auto corrections = std::make_shared<SchurCorrections>();
  const auto part_of = [&](double tolerance) {
    PressureSchur(l.system, l.jacobi, {}, corrections).enable_deferred_component(tolerance);
    return corrections->parts.front().get();
  };
  part_of(1e-3);
  EXPECT_FALSE(corrections->for_many_digits);
  const SchurCorrection* part = part_of(1e-6);
  EXPECT_TRUE(corrections->for_many_digits);
  EXPECT_EQ(corrections->parts.size(), 1U);
  EXPECT_EQ(part_of(1e-3), part) << "of more digits than it needs";
}

TEST(PressureSchur, TakesUpWeakPartsThatAreThere) {
  WithLines l(filled_shell("half"), 1, shake);
  const auto corrections = std::make_shared<SchurCorrections>();
  PressureSchur first(l.system, l.jacobi, {}, corrections);
  first.enable_deferred_component(1e-6);
  const SchurCorrection* part = corrections->parts.front().get();
  const auto p = noise(first.size(), 1);
  std::vector<double> of_first(p.size()), before(p.size()), after(p.size());
  first.apply(p, of_first);
  PressureSchur then(l.system, l.jacobi, {}, corrections);
  EXPECT_TRUE(then.has_deferred_component());
  then.apply(p, before);
  EXPECT_NE(before, of_first);
  then.enable_deferred_component(1e-6);
  then.apply(p, after);
  EXPECT_EQ(after, of_first);
  EXPECT_EQ(corrections->parts.front().get(), part);
}

// Noise is rich in the patterns that Q1/P0 leaves almost free.
TEST(PressureSchur, TakesWeakPatternsOutOfNoise) {
  const auto iterations = [](int after, int refine = 0) {
    Linearised l(small_eye(8), refine, 0);
    l.settings.pressures.after = after;
    Profiler profiler;
    auto solver = make_krylov_solver(l.settings, make_preconditioner_factory(l.settings, profiler), profiler);
    const Preparation prepared = solver->prepare(l.system);
    EXPECT_TRUE(prepared.ok);
    const CoupledOperator A(l.system, prepared.augmentation);
    std::vector<double> b(l.system->size()), x(b.size());
    std::ranges::copy(noise(l.system->layout().hexes, 1), l.system->layout().lambda(b).begin());
    const LinearReport report = solver->solve(A, b, x, 1e-6);
    EXPECT_TRUE(report.ok) << report.reason;
    return report.iterations;
  };
  const int with = iterations(0), without = iterations(1000);
  EXPECT_LE(2 * with, without);
  EXPECT_LE(with, 25);
  EXPECT_EQ(iterations(6), with) << "so many digits are sure to be slow";
  EXPECT_GT(iterations(10), with) << "waits without effect";
  const int with_hierarchy = iterations(0, 1), without_patterns = iterations(1000, 1);
  EXPECT_LE(2 * with_hierarchy, without_patterns);
  EXPECT_LE(with_hierarchy, 30);
  std::printf("%d iterations with, %d without; refined %d and %d\n", with, without, with_hierarchy,
              without_patterns);
}

}  // namespace
}  // namespace bulbus
