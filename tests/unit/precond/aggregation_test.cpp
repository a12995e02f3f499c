#include "precond/coarse/aggregation.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/solve/reduced.hpp"
#include "precond/amg/scalar_matrices.hpp"
#include "precond/make_preconditioner.hpp"
#include "precond/operators/displacement.hpp"
#include "tests/support/linearised.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

AggregationSettings aggregates_of(int nodes, int factorised = 100000) {
  AggregationSettings s;
  s.nodes = nodes, s.factorised = factorised;
  return s;
}

TEST(Aggregates, HoldEveryFreeNodeOnceInGroupsOfTheAskedSize) {
  Linearised l(small_eye(8), 0, 0);
  for (int nodes : {15, 40}) {
    const Aggregates groups = aggregate(*l.system, nodes);
    std::vector<int> members(groups.total);
    const DofMap& dofs = l.problem.dofs();
    for (int n = 0; n < l.problem.mesh().owned; ++n) {
      const bool wholly_held = dofs.constrained(n) && trace(dofs.projector(n)) < .5;
      EXPECT_EQ(groups.of[n] < 0, wholly_held);
      if (groups.of[n] >= 0) ++members[groups.of[n]];
    }
    EXPECT_GT(*std::ranges::min_element(members), 0);
    EXPECT_LE(*std::ranges::max_element(members), nodes + 10);
    EXPECT_GT(l.problem.mesh().owned / static_cast<double>(groups.total), .6 * nodes);
  }
}

// Of any coarse vector: Zᵀ A Z c by the operator, and by the matrix that was accumulated.
TEST(CoarseMatrix, IsTheGalerkinProjection) {
  for (const Scene& scene : {thin_plate(), filled_shell("octant"), small_eye(8)}) {
    Linearised l(scene, 0, .001);
    const auto plan = std::make_shared<RigidPlan>(*l.system, 20, Precision::full, 100000);
    const RigidModes modes = rigid_modes(*l.system, plan->groups);
    plan->matrix.clear();
    for_each_condensed_matrix(*l.system, Matrices::augmented,
                              [&](std::span<const int> d, std::span<const double> K) {
                                plan->matrix.add(plan->groups, modes.of, d, K);
                              });
    const int size = 6 * plan->groups.total, owned = l.problem.mesh().owned;
    std::vector<double> c = noise_vector(size, 3), got(size), want(size), fine(l.system->layout().primal()),
                        Af(fine);
    const int bodies = l.system->layout().bodies;
    const auto each = [&](auto visit) {
      for (int i = 0; i < bodies; ++i) visit(3 * owned + i, i, 1);
      for (int n = 0; n < owned; ++n)
        if (plan->groups.of[n] >= 0)
          for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 6; ++k) visit(3 * n + i, 6 * plan->groups.of[n] + k, modes.of[n][i][k]);
    };
    each([&](int i, int k, double Z) { fine[i] += Z * c[k]; });
    l.system->apply_displacement(fine, Af);
    each([&](int i, int k, double Z) { want[k] += Z * Af[i]; });
    for (const auto& e : l.system->body_extra()) got[e.row] += e.value * c[e.column];
    const Triplets t = plan->matrix.triplets();
    for (std::size_t e = 0; e < t.row.size(); ++e) {
      got[t.row[e]] += t.value[e] * c[t.col[e]];
      if (l.problem.symmetric() && t.row[e] != t.col[e]) got[t.col[e]] += t.value[e] * c[t.row[e]];
    }
    // modes are floats and not quite without constrained directions
    EXPECT_LT(relative_difference(got, want), 1e-6) << scene.model.regions.size();
  }
}

TEST(RigidModes, AreOrthonormalInEveryAggregate) {
  Linearised l(small_eye(8), 0, 0);
  const Aggregates groups = aggregate(*l.system, 30);
  const RigidModes modes = rigid_modes(*l.system, groups);
  std::vector<std::array<double, 36>> gram(groups.total);
  for (int n = 0; n < l.problem.mesh().owned; ++n)
    if (groups.of[n] >= 0)
      for (int i = 0; i < 36; ++i)
        for (int r = 0; r < 3; ++r) gram[groups.of[n]][i] += modes.of[n][r][i / 6] * modes.of[n][r][i % 6];
  const std::set<int> missing(modes.missing.begin(), modes.missing.end());
  for (int a = 0; a < groups.total; ++a)
    for (int i = 0; i < 36; ++i) {
      const bool one = i / 6 == i % 6 && !missing.contains(6 * a + i / 6);
      EXPECT_NEAR(gram[a][i], one, 1e-5);
    }
}

TEST(Aggregation, IsOneLinearMap) {
  for (const Scene& scene : {thin_plate(), cylinder(), filled_shell("octant"), small_eye(8)}) {
    Linearised l(scene, 0, 0);
    const auto plan = std::make_shared<AggregationPlan>(*l.system, aggregates_of(20), Precision::single);
    const Aggregation M(l.system, plan, {});
    EXPECT_EQ(M.setup_error(), "");
    EXPECT_TRUE(M.is_linear());
    const auto a = noise_primal(l.problem, 1), b = noise_primal(l.problem, 2);
    std::vector<double> Ma(a.size(), std::nan("")), Mb(Ma), Mab(Ma);
    M.apply(a, Ma);
    M.apply(b, Mb);
    M.apply(plus(a, 3, b), Mab);
    EXPECT_LT(relative_difference(Mab, plus(Ma, 3, Mb)), 1e-4);
  }
}

// M A takes the rigid motions that the aggregates have, and all that is rough, for what they are.
TEST(Aggregation, InvertsOnTheCoarseSpace) {
  Linearised l(thin_plate(), 0, 0);
  const auto plan = std::make_shared<AggregationPlan>(*l.system, aggregates_of(20), Precision::single);
  const Aggregation M(l.system, plan, {});
  const RigidModes modes = rigid_modes(*l.system, plan->rigid->groups);
  std::vector<double> rigid(l.system->layout().primal()), A(rigid), MA(rigid);
  for (int n = 0; n < l.problem.mesh().owned; ++n)
    if (plan->rigid->groups.of[n] >= 0)
      for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 6; ++k)
          rigid[3 * n + i] += modes.of[n][i][k] * noise(4, 6 * plan->rigid->groups.of[n] + k);
  DisplacementBlock(l.system).apply(rigid, A);
  M.apply(A, MA);
  EXPECT_LT(relative_difference(MA, rigid), 1e-5);
}

// What a new linearisation makes with an old plan is what it makes with its own.
TEST(Aggregation, PlansServeEveryLinearisation) {
  Linearised l(filled_shell("octant"), 0, 0);
  const auto plan = std::make_shared<AggregationPlan>(*l.system, aggregates_of(20), Precision::single);
  { const Aggregation first(l.system, plan, {}); }
  l.state = shaken(l.problem, l.state, .001, 7);
  l.linearise();
  const auto b = noise_primal(l.problem, 1);
  std::vector<double> old(b.size()), own(b.size());
  Aggregation(l.system, plan, {}).apply(b, old);
  const auto fresh = std::make_shared<AggregationPlan>(*l.system, aggregates_of(20), Precision::single);
  fresh->rigid->groups = plan->rigid->groups;
  Aggregation(l.system, fresh, {}).apply(b, own);
  EXPECT_LT(relative_difference(old, own), 1e-5);
}

// A block that is held at both ends and pressed on a side, each in one step alone.
Scene block_of_steps() {
  Scene s{generate(BlockShape{.upper = {1, 1, 6}, .nx = 3, .ny = 3, .nz = 12}), {}};
  s.model.regions["block"] = neo_hooke(.5);
  s.model.fix.push_back({"zmin", {"x", "y", "z"}});
  s.model.steps = {step("held"), step("pressed")};
  return s;
}

// What one factory makes of the second step, having served the first, against what a new one makes.
double change_by_history(const Scene& scene, Displacement displacement) {
  Linearised l(scene, 0, 0);
  l.settings.displacement = displacement;
  l.settings.aggregates = 20;
  DisplacementFactory used(l.settings), fresh(l.settings);
  used.make(l.system);
  l.problem.set_progress(1, l.state), l.problem.end_step();
  l.problem.begin_step(1, l.state), l.problem.set_progress(1, l.state);
  l.state = shaken(l.problem, l.state, .001, 7);
  l.linearise();
  const auto b = noise_primal(l.problem, 1);
  std::vector<double> old(b.size()), own(b.size());
  const auto M = used.make(l.system);
  EXPECT_EQ(M->setup_error(), "");
  M->apply(b, old);
  fresh.make(l.system)->apply(b, own);
  return relative_difference(old, own);
}

TEST(Aggregation, FollowsATangentThatIsNoMoreSymmetric) {
  Scene s = block_of_steps();
  LoadSpec side;
  side.surface = "xmax", side.pressure = "0.2";
  s.model.steps[1].loads = {side};
  EXPECT_LT(change_by_history(s, Displacement::aggregation), 1e-5);
  EXPECT_LT(change_by_history(s, Displacement::hybrid), 1e-5);
}

TEST(Aggregation, TakesInNodesThatAreReleased) {
  Scene s = block_of_steps();
  DisplaceSpec end = displace("zmax");
  end.x = end.y = end.z = "0.1";
  s.model.steps[0].displace = {end};
  s.model.steps[1].release = {"zmax"};
  EXPECT_LT(change_by_history(s, Displacement::aggregation), 1e-5);
}

// The diagonals are those of the operator, behind a body's entries too.
TEST(ScalarMatrices, HaveWhatRigidRegionsLeave) {
  const Linearised l(filled_shell("octant"), 0, .01);
  const auto scalar = scalar_matrices(*l.system);
  const DisplacementBlock A(l.system);
  const LocalMesh& mesh = l.problem.mesh();
  std::vector<double> found, expected;
  for (int n = 0; n < mesh.owned; ++n)
    for (int c = 0; c < 3; ++c) {
      std::vector<double> unit(A.size()), column(A.size());
      unit[3 * n + c] = 1;
      A.apply(unit, column);
      expected.push_back(column[3 * n + c]);
      for (int k = scalar[c].start[n]; k < scalar[c].start[n + 1]; ++k)
        if (scalar[c].columns[k] == mesh.first_node + n) found.push_back(scalar[c].values[k]);
    }
  EXPECT_LT(relative_difference(found, expected), 1e-6);
}

TEST(Aggregation, TakesFewIterations) {
  EXPECT_LE(iterations(thin_plate(), 0, Displacement::aggregation), 12);
  EXPECT_LE(iterations(small_eye(8), 0, Displacement::aggregation),
            iterations(small_eye(8), 0, Displacement::hybrid));
}

}  // namespace
}  // namespace bulbus
