#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

#include "contact/suture/suture_term.hpp"
#include "core/base/error.hpp"
#include "core/element/block_csr.hpp"
#include "core/mesh/generate/embed.hpp"
#include "core/mesh/generate/generate.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/support/solids.hpp"
#include "tests/support/term_tangent.hpp"
#include "tests/unit/contact/bodies.hpp"

namespace bulbus {
namespace {

using std::numbers::pi;

SutureSpec pair_at(double azimuth) {
  SutureSpec s;
  s.body = "b";
  s.surface = "outer";
  s.pair = SutureSpec::Pair{azimuth, 8.9, 0};
  return s;
}

struct SuturePoints : testing::Test {
  Mesh mesh = generate(ShellShape{.inner = 11, .outer = 12, .n = 24, .layers = 1, .part = "half"});
  std::vector<std::string> symmetry{"x"};
  std::vector<SuturePoint> points(const SutureSpec& spec) const {
    return suture_points(mesh, spec, symmetry, "sutures.s");
  }
  std::string fault(const SutureSpec& spec) const {
    try {
      points(spec);
    } catch (const InputError& f) {
      return f.key + "|" + f.what();
    }
    return "accepted";
  }
};

TEST_F(SuturePoints, PairLiesOnItsMeridianAtItsSpacing) {
  for (double azimuth : {0., 20., 40., 133., 180.})
    for (double axial : {0., 1.5}) {
      SutureSpec spec = pair_at(azimuth);
      spec.pair->axial = axial;
      const auto p = points_on_meridian(mesh, spec, "");
      const double middle = std::asin(axial / 12), half = 8.9 / 2 / 12;
      for (int i = 0; i < 2; ++i) {
        const double latitude = middle + (i == 0 ? -half : half), phi = azimuth * pi / 180;
        EXPECT_NEAR(p[i][0], 12 * std::cos(latitude) * std::sin(phi), 2e-2);
        EXPECT_NEAR(p[i][1], 12 * std::cos(latitude) * std::cos(phi), 2e-2);
        EXPECT_NEAR(p[i][2], 12 * std::sin(latitude), 2e-2);
        EXPECT_NEAR(p[i][0] * std::cos(phi), p[i][1] * std::sin(phi), 1e-7);
      }
    }
}

TEST_F(SuturePoints, PointsOnTheSymmetryPlaneOwnHalfTheirForce) {
  for (const SuturePoint& p : not_empty(points(pair_at(0)))) {
    EXPECT_EQ(p.share, .5);
    EXPECT_EQ(p.place[0], 0);
    EXPECT_TRUE(p.on_plane[0] && !p.on_plane[1] && !p.on_plane[2]);
  }
  for (const SuturePoint& p : not_empty(points(pair_at(20)))) {
    EXPECT_EQ(p.share, 1);
    EXPECT_FALSE(p.on_plane[0]);
  }
}

TEST_F(SuturePoints, BiteIsTheMeanOverItsCircle) {
  const SuturePoint p = points(pair_at(20))[1];
  double sum = 0, spread = 0;
  Point mean{0, 0, 0};
  for (std::size_t i = 0; i < p.nodes.size(); ++i) {
    EXPECT_GT(p.weights[i], 0);
    sum += p.weights[i];
    mean = mean + p.weights[i] * mesh.points[p.nodes[i]];
  }
  EXPECT_NEAR(sum, 1, 1e-14);
  EXPECT_LT(norm(mean - p.place), .03);
  // a linear field's second moment over a disc is r²/2, and the interpolation adds to it on cells of .39 mm
  for (std::size_t i = 0; i < p.nodes.size(); ++i)
    spread += p.weights[i] * dot(mesh.points[p.nodes[i]] - mean, mesh.points[p.nodes[i]] - mean);
  EXPECT_NEAR(spread, 1 / (2 * pi), .08);
}

TEST_F(SuturePoints, SmallBitesAreThePointItself) {
  for (double area : {0., 1e-8}) {
    SutureSpec spec = pair_at(20);
    spec.bite = area;
    for (const SuturePoint& p : not_empty(points(spec))) {
      Point mean{0, 0, 0};
      for (std::size_t i = 0; i < p.nodes.size(); ++i) mean = mean + p.weights[i] * mesh.points[p.nodes[i]];
      EXPECT_LE(p.nodes.size(), 4u);
      EXPECT_LT(norm(mean - p.place), 1e-3);
    }
  }
}

TEST_F(SuturePoints, GivenPlacesMoveToTheSurface) {
  SutureSpec spec;
  spec.body = "b";
  spec.surface = "outer";
  spec.points = {{8.4, 8.4, 2.8}, {0, 11.7, -3.6}};
  const auto p = points(spec);
  ASSERT_EQ(p.size(), 2u);
  EXPECT_NEAR(norm(p[0].place), 12, .01);
  EXPECT_NEAR(dot(unit({8.4, 8.4, 2.8}), unit(p[0].place)), 1, 1e-4);
  EXPECT_EQ(p[0].share, 1);
  EXPECT_EQ(p[1].share, .5);
}

TEST_F(SuturePoints, NodesOfASetShareEqually) {
  mesh.node_sets["knot"] = {5, 9};
  SutureSpec spec;
  spec.sets = {"knot"};
  const auto p = points(spec);
  ASSERT_EQ(p.size(), 1u);
  EXPECT_EQ(p[0].nodes, (std::vector<int>{5, 9}));
  EXPECT_EQ(p[0].weights, (std::vector<double>{.5, .5}));
}

TEST_F(SuturePoints, WhatDoesNotFitIsRefused) {
  SutureSpec spec = pair_at(20);
  spec.pair->spacing = 60;
  EXPECT_NE(fault(spec).find("sutures.s.pair.spacing|"), std::string::npos);
  EXPECT_NE(fault(pair_at(270)).find("does not meet"), std::string::npos);
  spec = pair_at(20);
  spec.surface = "oter";
  EXPECT_NE(fault(spec).find("'outer'"), std::string::npos);
  spec = pair_at(20);
  spec.points = {{1, 2, 3}};
  EXPECT_NE(fault(spec).find("2 placements: pair and points"), std::string::npos);
  EXPECT_NE(fault({}).find("no placement\n  give one of pair, points or sets"), std::string::npos);
  spec = {.surface = "outer", .points = {{0, 0, 12}, {6, 0, 8}}};
  EXPECT_NE(fault(spec).find(
                "sutures.s.points.1|the point lies 2 mm off 'outer'\n  The nearest point on it is [7."),
            std::string::npos);
}

/// Half a shell with a tire and one suture over it.
struct Suture : testing::Test {
  Mesh mesh = generate(ShellShape{.inner = 11, .outer = 12, .n = 8, .layers = 1, .part = "half"});
  std::vector<std::string> symmetry{"x"};
  LocalMesh local = distribute(mesh, std::vector<int>(mesh.hexes.size(), 0), Comm());
  std::shared_ptr<RigidSurface> tire =
      std::make_shared<RigidSurface>(body({.tire = TireShape{.radius = 12.1}}));
  State state{.x = local.X};

  SutureTerm term(SutureSpec spec) const {
    return {local, suture_points(mesh, spec, symmetry, "sutures.s"), tire, spec, "sutures.s"};
  }
  SutureTerm pulling(SutureSpec spec, double force) {
    SutureTerm t = term(spec);
    t.sew(force);
    t.begin_step(0, state);
    t.set_progress(1);
    return t;
  }
  std::vector<double> residual(const SutureTerm& t, const State& at) const {
    std::vector<double> f(at.x.size());
    t.add_residual(at, f, {});
    return f;
  }
  static Vec3<double> sum(std::span<const double> f) {
    Vec3<double> s{0, 0, 0};
    for (std::size_t i = 0; i < f.size(); i += 3) s = s + Point{f[i], f[i + 1], f[i + 2]};
    return s;
  }
  State moved(int seed, double amplitude) const {
    State s = state;
    s.x = plus(s.x, amplitude, noise_vector(s.x.size(), seed));
    return s;
  }
};

TEST_F(Suture, NodalForcesAddUpToFAlongTheStrings) {
  const SutureTerm t = pulling(pair_at(20), .1);
  ASSERT_EQ(t.strings().size(), 2u);
  std::vector<double> f(state.x.size()), reference_force(local.nodes());
  t.add_residual(state, f, reference_force);
  Vec3<double> expected{0, 0, 0};
  for (const auto& s : not_empty(t.strings())) {
    EXPECT_NEAR(norm(s.direction), 1, 1e-14);
    EXPECT_LT(norm(s.direction - unit(s.T - s.S)), 1e-12);
    EXPECT_EQ(s.force, .1);
    expected = expected - .1 * s.direction;
    // outwards, and over the tire to the other point
    EXPECT_GT(dot(s.direction, unit({s.S[0], s.S[1], 0})), .5);
    EXPECT_LT(s.direction[2] * s.S[2], 0);
    EXPECT_NEAR(dot(s.direction, cross({0, 0, 1}, s.S)), 0, 1e-12);
  }
  const Vec3<double> total = sum(f);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(total[c], expected[c], 1e-14);
  EXPECT_GT(norm(total), .1);
  EXPECT_NEAR(std::accumulate(reference_force.begin(), reference_force.end(), 0.), .2, 1e-14);
}

TEST_F(Suture, OnTheSymmetryPlaneHalfTheForceInThePlane) {
  for (bool follow : {false, true}) {
    SutureSpec spec = pair_at(0);
    spec.follow = follow;
    const SutureTerm t = pulling(spec, .1);
    Vec3<double> expected{0, 0, 0};
    for (const auto& s : not_empty(t.strings())) {
      EXPECT_EQ(s.S[0], 0);
      EXPECT_EQ(s.force, .1);
      expected = expected - .05 * s.direction;
    }
    const Vec3<double> total = sum(residual(t, state));
    EXPECT_NEAR(total[0], 0, 1e-15);
    for (int c = 1; c < 3; ++c) EXPECT_NEAR(total[c], expected[c], 1e-14);
  }
}

TEST_F(Suture, ForceIsRampedAndKept) {
  SutureTerm t = term(pair_at(20));
  t.begin_step(0, state);  // at rest
  EXPECT_EQ(largest(residual(t, state)), 0);
  t.sew(.2);
  t.begin_step(1, state);
  t.set_progress(.25);
  const auto quarter = residual(t, state);
  t.set_progress(1);
  EXPECT_LT(relative_difference(plus(quarter, 3, quarter), residual(t, state)), 1e-14);
  t.freeze();
  EXPECT_EQ(t.strings()[0].force, .2);
  t.begin_step(2, state);
  t.set_progress(.5);
  EXPECT_EQ(t.strings()[0].force, .2);
  t.sew(.1);
  t.set_progress(.5);
  EXPECT_NEAR(t.strings()[0].force, .15, 1e-15);
}

TEST_F(Suture, DirectionThatDoesNotFollowIsHeldUntilAnIncrementConverges) {
  SutureSpec spec = pair_at(20);
  spec.follow = false;
  SutureTerm t = pulling(spec, .1);
  const auto before = residual(t, state);
  const State other = moved(3, .3);
  EXPECT_EQ(residual(t, other), before);
  t.roll_back();
  EXPECT_EQ(residual(t, other), before);
  t.commit(other);
  EXPECT_GT(relative_difference(residual(t, other), before), 1e-3);
  // the tire moves, too
  for (std::size_t p = 2; p < tire->places.size(); p += 3) tire->places[p] += .5;
  const auto committed = residual(t, other);
  t.commit(other);
  EXPECT_GT(relative_difference(residual(t, other), committed), 1e-3);
}

TEST_F(Suture, FollowerTangentIsTheDerivativeOfItsForce) {
  for (double azimuth : {0., 20.}) {
    SutureSpec spec = pair_at(azimuth);
    spec.follow = true;
    SutureTerm t = pulling(spec, .7);
    const State at = moved(5, .1);
    const auto dx = noise_vector(at.x.size(), 8);
    const auto expected = derivative(
        [&](std::span<const double> x) {
          State s = at;
          s.x.assign(x.begin(), x.end());
          return residual(t, s);
        },
        at.x, dx);
    const auto found = action(t, at, dx);
    EXPECT_GT(largest(found), 1e-3);
    EXPECT_LT(relative_difference(found, expected), 1e-9);
  }
}

// Whatever the increments, a string that has turned pulls where it points: plane and direction are of now.
TEST_F(Suture, ForceIsAFunctionOfTheStateAlone) {
  SutureTerm t = pulling(pair_at(20), .7), fresh = pulling(pair_at(20), .7);
  const State other = moved(3, .3);
  t.commit(moved(4, .2));
  fresh.commit(other);
  EXPECT_EQ(residual(t, other), residual(fresh, other));
}

TEST_F(Suture, VisitedMatricesActAsTheTangent) {
  SutureSpec spec = pair_at(20);
  spec.follow = true;
  SutureTerm t = pulling(spec, .7);
  const auto tangent = tangent_at(t, state);
  const BlockCsr A(local.nodes(), [&](const ContributionVisitor& v) { tangent->visit(v); });
  const auto dx = noise_vector(state.x.size(), 8);
  std::vector<double> f(dx.size());
  A.apply(dx, f);
  EXPECT_LT(relative_difference(f, action(*tangent, dx)), 1e-13);
}

TEST_F(Suture, HeldDirectionHasNoTangent) {
  SutureSpec spec = pair_at(20);
  spec.follow = false;
  SutureTerm t = pulling(spec, .7);
  EXPECT_EQ(tangent_at(t, state), nullptr);
}

TEST_F(Suture, PointInsideTheOutlineIsAFault) {
  SutureTerm t = pulling(pair_at(20), .1);
  const auto before = residual(t, state);
  for (double& c : tire->places) c *= .86;  // down over the points, and wide of them
  for (std::size_t p = 2; p < tire->places.size(); p += 3) tire->places[p] *= 2;
  t.commit(state);
  EXPECT_TRUE(t.strings()[0].lost && t.strings()[1].lost);
  EXPECT_EQ(residual(t, state), before);
  SutureTerm fresh = term(pair_at(20));
  fresh.sew(.1);
  EXPECT_THROW(fresh.begin_step(0, state), InputError);
  SutureTerm beside = term(pair_at(100));
  beside.begin_step(0, state);  // does not pull
  beside.sew(.1);
  EXPECT_THROW(beside.begin_step(1, state), InputError);
}

// A radial buckle along the meridian: the plane is across it.
TEST_F(Suture, OutlineMayBeTakenAcrossAnotherGenerator) {
  tire = std::make_shared<RigidSurface>(body({.cylinder = RodShape{{0, 13.5, 0}, {0, 0, 1}, 1, 10, 200}}));
  SutureSpec spec;
  spec.body = "b";
  spec.surface = "outer";
  spec.points = {{3, 11.6, 0}};
  spec.generator = {0, 0, 1};
  spec.bite = 0;
  const SutureTerm t = pulling(spec, .1);
  const auto& s = t.strings()[0];
  const double D = std::hypot(s.S[0], 13.5 - s.S[1]),
               angle = std::atan2(13.5 - s.S[1], -s.S[0]) - std::asin(1 / D);
  EXPECT_NEAR(s.direction[0], std::cos(angle), 1e-3);
  EXPECT_NEAR(s.direction[1], std::sin(angle), 1e-3);
  EXPECT_NEAR(s.direction[2], 0, 1e-12);
}

}  // namespace
}  // namespace bulbus
