#include "contact/search/local_search.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "contact/search/nearest_point.hpp"
#include "contact/surfaces/meridians.hpp"
#include "tests/support/sheets.hpp"

namespace bulbus {
namespace {

constexpr SearchLimits limits{.depth = .2, .reach = 1};
constexpr Vec3<double> down{0, 0, -1};

/// A surface all of whose triangles are candidates.
struct Surface {
  std::vector<double> places;
  Facets facets;
  std::vector<int> all = std::vector<int>(facets.triangles.size());
  Surface(std::vector<double> places, Facets f) : places(std::move(places)), facets(std::move(f)) {
    std::iota(all.begin(), all.end(), 0);
  }
  MasterSurface master() const { return {facets, places}; }
  Selection select(const Vec3<double>& x, const Vec3<double>& N, int start = -1,
                   const SearchLimits& l = limits) const {
    return bulbus::select(master(), x, N, start, all, l);
  }
  /// Is the node pushed?
  bool active(const Vec3<double>& x, const Vec3<double>& N) const {
    const Selection s = select(x, N);
    return s.triangle >= 0 && project(x, master().corners(s.triangle)).gap < 0;
  }
};

Surface flat(int n) {
  Sheets s;
  const auto faces = s.add(n, n, [](double u, double v) { return Vec3<double>{u, v, 0}; });
  return {s.X, split(faces)};
}

TEST(CrossLine, AgreesWithThePlaneAndThePerpendicularProjection) {
  const Triangle t{{{0, 0, 0}, {1, 0, .2}, {.1, 1, 0}}};
  const Vec3<double> x{.3, .2, -.1}, n = project(x, t).normal;
  const Crossing along_normal = cross_line(x, {-n[0], -n[1], -n[2]}, t);
  ASSERT_TRUE(along_normal.facing);
  const Pair p = project(x, t);
  EXPECT_NEAR(along_normal.distance, p.gap, 1e-15);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(along_normal.weights[i], p.weights[i], 1e-14);
  EXPECT_FALSE(cross_line(x, n, t).facing);
}

TEST(Track, WalksAcrossEdgesToTheTriangleUnderTheNode) {
  const Surface s = flat(8);
  const int found = track(s.master(), {.62, .41, .3}, down, 0);
  ASSERT_GE(found, 0);
  EXPECT_TRUE(cross_line({.62, .41, .3}, down, s.master().corners(found)).inside());
  EXPECT_EQ(track(s.master(), {1.2, .4, .1}, down, 0), -1);
  EXPECT_EQ(track(flat(40).master(), {.9, .9, 0}, down, 0), -1) << "more than 20 steps";
}

TEST(Select, FallsBackToTheCandidatesWhereTrackingGivesUp) {
  const Surface s = flat(40);
  const Selection tracked = s.select({.9, .91, -.05}, down, 0), fresh = s.select({.9, .91, -.05}, down);
  EXPECT_GE(fresh.triangle, 0);
  EXPECT_EQ(tracked.triangle, fresh.triangle);
}

TEST(Select, EveryPlaceHasATriangleWhateverTheStart) {
  const Surface s = flat(5);
  for (int k = 0; k < 2000; ++k) {
    const Vec3<double> x{.5 + .49 * noise(1, k), .5 + .49 * noise(2, k), -.05};
    const Vec3<double> N = unit({.1 * noise(3, k), .1 * noise(4, k), -1});
    const int start = k % 50;
    const Selection a = s.select(x, N), b = s.select(x, N, start);
    ASSERT_GE(a.triangle, 0);
    EXPECT_EQ(a.triangle, b.triangle);
  }
}

TEST(Select, RejectsTheWrongSide) {
  const Surface s = flat(3);
  EXPECT_EQ(s.select({.5, .4, -.05}, {0, 0, 1}).triangle, -1) << "looks the same way";
  EXPECT_EQ(s.select({.5, .4, -.3}, down).triangle, -1) << "deeper than allowed";
  EXPECT_GE(s.select({.5, .4, -.19}, down).triangle, 0);
  const int there = s.select({.5, .4, .1}, down).triangle;
  EXPECT_EQ(s.select({.5, .4, -.3}, down, there).triangle, there) << "known to have been in front";
}

TEST(Select, TakesTheNearerOfTwoLayers) {
  Sheets sheets;
  auto faces = sheets.add(4, 4, [](double u, double v) { return Vec3<double>{u, v, 0}; });
  const auto upper = sheets.add(3, 3, [](double u, double v) { return Vec3<double>{u, v, .15}; });
  faces.insert(faces.end(), upper.begin(), upper.end());
  const Surface s(sheets.X, split(faces));
  const SearchLimits half{.depth = .075, .reach = .3};
  const auto layer = [&](double z, int start = -1) {
    const int t = s.select({.4, .3, z}, down, start, half).triangle;
    return t < 0 ? -1 : t < 32 ? 0 : 1;
  };
  EXPECT_EQ(layer(.2), 1);
  EXPECT_EQ(layer(.1), 1);   // .05 behind the upper one
  EXPECT_EQ(layer(.05), 0);  // .10 behind it: in front of the lower one
  EXPECT_EQ(layer(-.05), 0);
  EXPECT_EQ(layer(-.1), -1);
  EXPECT_EQ(layer(.05, s.select({.4, .3, .2}, down, -1, half).triangle), 1) << "came from above";
}

TEST(Select, TiesGoToTheLowestNumberWhateverTheCandidates) {
  Sheets sheets;
  const auto faces = sheets.add(4, 4, [](double u, double v) {
    return Vec3<double>{u, v, .31 * u + .17 * v};
  });
  const Surface s(sheets.X, split(faces));
  const Vec3<double> x{.5, .5, .19};  // a corner of six triangles
  const int lowest = s.select(x, down).triangle;
  for (int t = 0; t < lowest; ++t) EXPECT_FALSE(cross_line(x, down, s.master().corners(t)).inside());
  for (int k = 0; k < 20; ++k) {
    Vec3<double> shaken = x;
    for (int c = 0; c < 3; ++c) shaken[c] += 1e-13 * noise(k, c);
    EXPECT_EQ(s.select(shaken, down).triangle, lowest);
  }
  // fewer candidates, as another rank's search or another margin would give
  std::vector<int> some;
  for (int t : s.all)
    if (nearest_point(x, s.master().corners(t)).distance < .3) some.push_back(t);
  EXPECT_LT(some.size(), s.all.size());
  EXPECT_EQ(select(s.master(), x, down, -1, some, limits).triangle, lowest);
}

/// Signed distance from a box about the origin with half widths 1, 2, .5 in x, y, z and the direction away
/// from it.
struct BoxPlace {
  double distance;
  Vec3<double> out;
};
BoxPlace from_box(const Vec3<double>& x) {
  const Vec3<double> half{1, 2, .5};
  Vec3<double> over;
  double inside = -1e9;
  int axis = 0;
  for (int c = 0; c < 3; ++c) {
    const double d = std::abs(x[c]) - half[c];
    if (d > inside) inside = d, axis = c;
    over[c] = std::copysign(std::max(d, 0.), x[c]);
  }
  if (inside > 0) return {norm(over), unit(over)};
  Vec3<double> out{0, 0, 0};
  out[axis] = std::copysign(1., x[axis]);
  return {inside, out};
}

TEST(Select, LosesNoNodeInAConvexBody) {
  const auto rigid = box(1, .5, 4);
  const Surface s(rigid->reference, rigid->facets);
  int inside = 0, outside = 0;
  for (int k = 0; k < 20000; ++k) {
    const Vec3<double> x{1.05 * noise(1, k), 2.05 * noise(2, k), .55 * noise(3, k)};
    const BoxPlace place = from_box(x);
    if (std::abs(place.distance) > .1) continue;
    // the slave looks at the nearest face, more or less: at edges, at two
    const Vec3<double> N = unit({-place.out[0] + .5 * noise(4, k), -place.out[1] + .5 * noise(5, k),
                                 -place.out[2] + .5 * noise(6, k)});
    if (place.distance < 0) {
      ++inside;
      ASSERT_TRUE(s.active(x, N)) << x[0] << " " << x[1] << " " << x[2];
    } else if (const Vec3<double> straight{-place.out[0], -place.out[1], -place.out[2]}; ++outside) {
      ASSERT_FALSE(s.active(x, straight)) << x[0] << " " << x[1] << " " << x[2];
    }
  }
  EXPECT_GT(inside, 2000);
  EXPECT_GT(outside, 1000);
}

TEST(Select, PushesOutOfAConcaveCorner) {
  // floor z = 0 for x < 0 and wall x = 0 for z > 0 of a body below and to the right
  Sheets sheets;
  auto faces = sheets.add(2, 2, [](double u, double v) { return Vec3<double>{u - 1, v, 0}; });
  const int first = sheets.nodes();
  auto wall = sheets.add(2, 2, [](double u, double v) { return Vec3<double>{0, v, u}; });
  for (Quad& q : wall) {
    for (int& n : q)
      if (sheets.X[3 * n + 2] == 0) n = 2 + 3 * ((n - first) / 3);  // joined along the corner
  }
  for (const Quad& q : wall) faces.push_back(q);
  const Surface s(sheets.X, split(faces));
  ASSERT_LT(project({-.1, .3, .3}, s.master().corners(8)).normal[0], -.99);
  const Vec3<double> N = unit({.6, 0, -.8});
  // in front of the floor, behind the wall; behind both; behind both where the line misses both
  for (const Vec3<double>& x :
       {Vec3<double>{.05, .3, .1}, {.05, .3, -.04}, {.02, .3, -.1}, {.1, .3, -.02}, {.05, .5, -.05}})
    EXPECT_TRUE(s.active(x, N)) << x[0] << " " << x[2];
  for (const Vec3<double>& x : {Vec3<double>{-.05, .3, .1}, {-.01, .3, .01}, {-.1, .5, .02}})
    EXPECT_FALSE(s.active(x, N)) << x[0] << " " << x[2];
  // the line meets the wall beyond reach; nearest is the corner's edge or vertex, and the floor looks at the
  // node more
  for (double y : {.3, .5}) {
    const int t = s.select({.02, y, -.01}, unit({.05, 0, -1}), -1, {.depth = .2, .reach = .3}).triangle;
    ASSERT_GE(t, 0);
    EXPECT_NEAR(project({.02, y, -.01}, s.master().corners(t)).gap, -.01, 1e-15);
  }
}

// Outside next to the tip of a blade, in front of one flank and behind the plane of the other.
TEST(Select, PlanesEndAtASharpEdge) {
  const auto blade = prism({{.18, -.5}, {0, .5}, {-.18, -.5}}, 3);
  const Surface s(blade->reference, blade->facets);
  const Vec3<double> x{.045, .2, .522}, N{1, 0, 0};
  const Selection free = s.select(x, N);
  EXPECT_EQ(free.triangle, -1);
  EXPECT_NEAR(free.distance, std::hypot(.045, .022), 1e-15);
}

TEST(Select, StopsNothingBeyondARim) {
  const Surface s = flat(3);
  EXPECT_EQ(s.select({1.01, .5, -.05}, down).triangle, -1);
  EXPECT_GE(s.select({1.001, .5, -.05}, down).triangle, 0) << "less than a hundredth of a triangle";
  EXPECT_TRUE(s.active({.999, .5, -.05}, down));
  EXPECT_TRUE(s.active({.999, .5, -.05}, unit({-.3, 0, -1})))
      << "the line slips past the rim, the projection does not";
}

TEST(Select, TellsHowFarAFreeNodeIs) {
  const Surface s = flat(3);
  EXPECT_NEAR(s.select({.4, .5, .3}, down).distance, .3, 1e-15);
  EXPECT_NEAR(s.select({1.3, .5, .4}, down).distance, .5, 1e-15);
  EXPECT_EQ(s.select({.5, .5, 3}, down).distance, limits.reach);
}

TEST(NearestPoint, BeatsEverySampledPoint) {
  for (int seed = 0; seed < 200; ++seed) {
    Triangle t;
    for (int i = 0; i < 9; ++i) t[i / 3][i % 3] = noise(seed, i);
    const Vec3<double> x{2 * noise(seed, 20), 2 * noise(seed, 21), 2 * noise(seed, 22)};
    const NearestPoint p = nearest_point(x, t);
    double best = 1e9;
    for (int i = 0; i <= 30; ++i)
      for (int j = 0; i + j <= 30; ++j) {
        Vec3<double> r = x;
        for (int c = 0; c < 3; ++c) r[c] -= (i * t[0][c] + j * t[1][c] + (30 - i - j) * t[2][c]) / 30;
        best = std::min(best, norm(r));
      }
    EXPECT_LE(p.distance, best + 1e-14);
    EXPECT_GT(p.distance, best - .15);
    EXPECT_NEAR(p.weights[0] + p.weights[1] + p.weights[2], 1, 1e-14);
    EXPECT_GE(std::ranges::min(p.weights), 0);
  }
}

}  // namespace
}  // namespace bulbus
