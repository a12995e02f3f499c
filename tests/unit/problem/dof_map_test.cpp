#include "core/problem/dof_map.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/mesh/distributed/partition.hpp"
#include "tests/support/solids.hpp"

namespace bulbus {
namespace {

Vec3<double> unit(Vec3<double> v) {
  const double length = norm(v);
  for (double& c : v) c /= length;
  return v;
}

Vec3<double> times(const Mat3<double>& P, const Vec3<double>& v) {
  Vec3<double> r;
  for (int i = 0; i < 3; ++i) r[i] = P(i, 0) * v[0] + P(i, 1) * v[1] + P(i, 2) * v[2];
  return r;
}

struct DofMapTest : testing::Test {
  Comm comm;
  Mesh mesh = shaken_block(4, 2, 2);
  LocalMesh local = distribute(mesh, partition(mesh, comm.size()), comm);
  Vec3<double> skew = unit({1, 2, -.5}), other = unit({.3, -1, .4}), axis{0, 0, 1};

  /// The body of the first eight nodes below z = 0.5 where x > 2.5, all six motions or fewer.
  RigidBody body(std::array<bool, 6> free = {true, true, true, true, true, true}) const {
    std::vector<int> nodes;
    for (int n = 0; n < static_cast<int>(mesh.points.size()); ++n)
      if (mesh.points[n][0] > 2.5) nodes.push_back(n);
    return {"body", local.local(nodes), {3.1, .9, 1.2}, free};
  }
  State start(const DofMap& dofs) const {
    State s{local.X, {}, {}, std::vector<Pose>(dofs.bodies().size())};
    for (Pose& p : s.bodies) p = {rotation({.3, -.2, .5}), {.1, .2, -.3}};
    for (std::size_t b = 0; b < s.bodies.size(); ++b) dofs.bodies()[b].place(s.bodies[b], local.X, s.x);
    return s;
  }
  /// Local number of a Mesh node on the ranks that have it.
  std::vector<int> here(int mesh_node) const { return local.local(std::vector<int>{mesh_node}); }
  std::vector<Constraint> hold(int mesh_node, const Vec3<double>& d, double value = 0) const {
    std::vector<Constraint> holds;
    for (int n : here(mesh_node)) holds.push_back({n, d, [value](double s) { return value * s; }});
    return holds;
  }
};

TEST_F(DofMapTest, SkewAndAxisHoldsOnOneNodeMakeAProjector) {
  DofMap dofs(local, {});
  dofs.constrain("a", hold(7, skew));
  dofs.constrain("b", hold(7, axis));
  dofs.build();
  for (int n : here(7)) {
    const Mat3<double> P = dofs.projector(n), PP = P * P;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        EXPECT_NEAR(PP(i, j), P(i, j), 1e-15);
        EXPECT_NEAR(P(i, j), P(j, i), 1e-15);
      }
    EXPECT_NEAR(trace(P), 1, 1e-15);
    EXPECT_LT(norm(times(P, skew)) + norm(times(P, axis)), 1e-15);
    EXPECT_TRUE(dofs.constrained(n));
    EXPECT_TRUE(dofs.constrains(n, skew));
    EXPECT_TRUE(dofs.constrains(n, unit({skew[0], skew[1], 3})));
    EXPECT_FALSE(dofs.constrains(n, other));
  }
  EXPECT_EQ(dofs.free_unknowns(), 3 * local.all_nodes - 2);
}

TEST_F(DofMapTest, ThreeIndependentHoldsHoldEverything) {
  DofMap dofs(local, {});
  dofs.constrain("a", hold(7, skew)), dofs.constrain("b", hold(7, axis)), dofs.constrain("c", hold(7, other));
  dofs.build();
  for (int n : here(7))
    for (int i = 0; i < 9; ++i) EXPECT_EQ(dofs.projector(n)(i / 3, i % 3), 0);
  EXPECT_EQ(dofs.free_unknowns(), 3 * local.all_nodes - 3);
}

TEST_F(DofMapTest, DependentHoldsThatAgreeAreAccepted) {
  DofMap dofs(local, {});
  const Vec3<double> along{1, 2, 0};
  dofs.constrain("a", hold(7, {1, 0, 0}, .5)), dofs.constrain("b", hold(7, {0, 1, 0}, -.2));
  dofs.constrain("c", hold(7, unit(along), (.5 - .4) / norm(along)));
  EXPECT_NO_THROW(dofs.build());
  EXPECT_EQ(dofs.free_unknowns(), 3 * local.all_nodes - 2);
}

TEST_F(DofMapTest, DependentHoldsThatContradictAreRefused) {
  DofMap dofs(local, {});
  dofs.constrain("a", hold(7, skew, .5)), dofs.constrain("b", hold(7, skew, .5001));
  if (here(7).empty()) return;
  try {
    dofs.build();
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("over-constrained: node 8 "), std::string::npos) << e.what();
  }
}

TEST_F(DofMapTest, DefectLeadsToThePrescribedPlace) {
  DofMap dofs(local, {});
  dofs.constrain("a", hold(7, skew, .5)), dofs.constrain("b", hold(7, axis, -.3)),
      dofs.constrain("c", hold(2, other, .1));
  dofs.build();
  State s{local.X, {}, {}, {}};
  for (std::size_t i = 0; i < s.x.size(); ++i) s.x[i] += .01;
  std::vector<double> du(s.x.size(), 7);
  const double size = dofs.prescribed_increment(s, .6, du);
  EXPECT_GT(size, .1);
  s.x = plus(s.x, 1, du);
  for (int n : here(7)) {
    const Vec3<double> u = minus(at(s.x, n), at(local.X, n));
    EXPECT_NEAR(dot(u, skew), .3, 1e-15);
    EXPECT_NEAR(dot(u, axis), -.18, 1e-15);
  }
  EXPECT_LT(dofs.prescribed_increment(s, .6, du), 1e-14);
  EXPECT_LT(largest(du), 1e-14);
}

TEST_F(DofMapTest, FrozenHoldsStayAtTheEndOfTheirStep) {
  DofMap dofs(local, {});
  dofs.constrain("a", hold(7, skew, .5));
  dofs.build();
  dofs.freeze();
  dofs.build();
  const State s{local.X, {}, {}, {}};
  std::vector<double> du(s.x.size());
  EXPECT_NEAR(dofs.prescribed_increment(s, 0, du), .5, 1e-15);
}

TEST_F(DofMapTest, ReleasedHoldsAreGone) {
  DofMap dofs(local, {});
  dofs.constrain("a", hold(7, skew));
  dofs.build();
  EXPECT_FALSE(dofs.release("b"));
  EXPECT_TRUE(dofs.release("a"));
  dofs.build();
  EXPECT_EQ(dofs.free_unknowns(), 3 * local.all_nodes);
}

TEST_F(DofMapTest, ReduceIsTheTransposeOfExpand) {
  for (const std::array<bool, 6> free :
       {std::array{true, true, true, true, true, true}, {false, true, true, true, false, false}}) {
    DofMap dofs(local, {body(free)});
    dofs.constrain("a", hold(7, skew)), dofs.constrain("b", hold(7, axis)),
        dofs.constrain("c", hold(5, other)), dofs.constrain("d", hold(44, axis));
    dofs.build();
    const State state = start(dofs);
    std::vector<double> q, f(local.X.size());
    for (int n = 0; n < local.owned; ++n)
      for (int c = 0; c < 3; ++c) q.push_back(noise(1, 3 * local.input_node[n] + c));
    for (int i = 0; i < dofs.tail_size(); ++i) q.push_back(noise(2, i));
    for (int n = 0; n < local.owned; ++n)  // accumulated forces: the owners' alone count
      for (int c = 0; c < 3; ++c) f[3 * n + c] = noise(3, 3 * local.input_node[n] + c);
    for (std::size_t i = 3 * local.owned; i < f.size(); ++i) f[i] = 1e6;
    std::vector<double> dx(f.size(), NAN), r(q.size(), NAN);
    dofs.expand(state, q, dx);
    dofs.reduce(state, f, r);
    EXPECT_NEAR(comm.sum(inner(r, q)),
                comm.sum(inner(std::span(f).first(3 * local.owned), std::span(dx).first(3 * local.owned))),
                1e-11);
    // held parts and nodes of bodies get nothing
    std::vector<double> again(local.X.size());
    std::copy_n(r.begin(), 3 * local.owned, again.begin());
    dofs.project(again);
    EXPECT_LT(largest(plus(std::span(again).first(3 * local.owned), -1, std::span(r).first(3 * local.owned))),
              1e-14);
    // ghosts move as their owners do
    std::vector<double> owners = dx;
    local.halo.update_ghosts(owners);
    EXPECT_LT(largest(plus(owners, -1, dx)), 1e-14);
  }
}

TEST_F(DofMapTest, HeldPartAndFreePartAddUpToTheWhole) {
  DofMap dofs(local, {body()});
  dofs.constrain("a", hold(7, skew)), dofs.constrain("c", hold(5, other));
  dofs.build();
  const State state = start(dofs);
  std::vector<double> q = noise_vector(dofs.primal_size(), 4), dx(local.X.size()), y(q.size());
  dofs.expand(state, q, dx);
  dofs.add_constrained(q, 2, y);
  for (int n = 0; n < local.owned; ++n)
    for (int i = 3 * n; i < 3 * n + 3; ++i)
      EXPECT_NEAR(y[i], dofs.body_of(n) >= 0 ? 2 * q[i] : 2 * (q[i] - dx[i]), 1e-15);
}

TEST_F(DofMapTest, MoveKeepsBodiesRigid) {
  DofMap dofs(local, {body()});
  dofs.build();
  State state = start(dofs);
  std::vector<double> q(dofs.primal_size()), dx(local.X.size());
  for (int i = 0; i < dofs.tail_size(); ++i) q[3 * local.owned + i] = noise(8, i);
  dofs.expand(state, q, dx);
  dofs.move(state, dx, q, .7);
  const auto nodes = dofs.bodies()[0].nodes();
  for (int a : nodes)
    for (int b : nodes)
      ASSERT_NEAR(norm(minus(at(state.x, a), at(state.x, b))), norm(minus(at(local.X, a), at(local.X, b))),
                  1e-13);
}

TEST_F(DofMapTest, BodiesCountSixUnknownsAndTheirNodesNone) {
  DofMap dofs(local, {body({true, true, false, false, false, true})});
  dofs.build();
  EXPECT_EQ(dofs.free_unknowns(), 3 * (local.all_nodes - 18) + 3);
}

}  // namespace
}  // namespace bulbus
