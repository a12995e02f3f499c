#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>

#include "app/eye/eye.hpp"
#include "core/base/error.hpp"
#include "core/mesh/generate/embed.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/quality.hpp"
#include "tests/support/not_empty.hpp"

namespace bulbus {
namespace {

Mesh eye(int n) {
  EyeSettings settings;
  settings.n = n;
  return generate(settings);
}

const Mesh& working_eye() {
  static const Mesh mesh = eye(14);
  return mesh;
}

double cavity(const Mesh& mesh) {
  double sum = 0;
  for (const Quad& q : mesh.surfaces.at("cavity")) sum -= volume_flux(corners(mesh, q))[0];
  return sum;
}

TEST(Eye, CountsScaleWithTheCubeOfN) {
  EXPECT_EQ(working_eye().hexes.size(), 7350u);
  EXPECT_EQ(eye(28).hexes.size(), 8u * 7350);
}

TEST(Eye, LayersMultiplyTheCellsOfTheCoatsAlone) {
  EyeSettings settings;
  const Mesh& once = working_eye();
  settings.layers = 3;
  const Mesh thrice = generate(settings);
  const auto before = quality(once), after = quality(thrice);
  for (std::size_t r = 0; r < before.size(); ++r) {
    const bool coat = before[r].region != "lens" && before[r].region != "optic_nerve";
    EXPECT_EQ(after[r].count, (coat ? 3 : 1) * before[r].count) << before[r].region;
    EXPECT_NEAR(after[r].volume, before[r].volume, 1e-3 * before[r].volume) << before[r].region;
    EXPECT_GT(after[r].least, .5) << before[r].region;
  }
  EXPECT_EQ(nodes_of(thrice, "outer_sclera").size(), nodes_of(once, "outer_sclera").size());
}

TEST(Eye, IsRegularAtEveryN) {
  for (int n : {8, 10, 14, 20, 28})
    for (const RegionQuality& q : not_empty(quality(eye(n)))) {
      EXPECT_GT(q.count, 0) << q.region;
      EXPECT_GT(q.least, q.region == "lens" || q.region == "ciliary_body" ? .6 : .8)
          << q.region << ", n = " << n;
      if (n == 14)
        std::printf("%-13s %5d hexahedra, %8.3f mm3, scaled Jacobian: least %.3f, 5 %% %.3f, mean %.3f\n",
                    q.region.c_str(), q.count, q.volume, q.least, q.five_percent, q.mean);
    }
}

TEST(Eye, NamedSurfacesMakeUpTheBoundary) {
  const Mesh& mesh = working_eye();
  const auto size = [&](const char* name) { return mesh.surfaces.at(name).size(); };
  EXPECT_EQ(size("cavity") + size("outside") + size("nerve_end") + size("symmetry"),
            boundary_faces(mesh).size());
  EXPECT_EQ(size("outer_sclera") + size("outer_cornea") + size("nerve_side"), size("outside"));
  EXPECT_LT(size("inner_retina") + size("lens_surface"), size("cavity"));
  for (const char* name : {"inner_retina", "lens_surface", "nerve_end"}) EXPECT_GT(size(name), 0u) << name;
}

TEST(Eye, BoundaryIsWatertight) {
  const Mesh& mesh = working_eye();
  Point sum{};
  for (const Quad& q : boundary_faces(mesh)) sum = sum + volume_flux(corners(mesh, q));
  double volume = 0;
  for (const RegionQuality& q : quality(mesh)) volume += q.volume;
  for (double v : sum) EXPECT_NEAR(v, volume, 1e-8);
}

/// Every edge runs once in either direction, or lies on x = 0.
TEST(Eye, WetSurfaceIsClosedUpToTheSymmetryPlane) {
  const Mesh& mesh = working_eye();
  std::map<std::pair<int, int>, int> directed;
  for (const Quad& q : mesh.surfaces.at("cavity"))
    for (int c = 0; c < 4; ++c) ++directed[{q[c], q[(c + 1) % 4]}];
  int cut = 0;
  for (const auto& [edge, count] : not_empty(directed)) {
    ASSERT_EQ(count, 1);
    if (directed.count({edge.second, edge.first})) continue;
    ++cut;
    EXPECT_EQ(mesh.points[edge.first][0], 0);
    EXPECT_EQ(mesh.points[edge.second][0], 0);
  }
  EXPECT_GT(cut, 0);
}

TEST(Eye, SymmetryPlaneIsExactAndNothingLiesBehindIt) {
  const Mesh& mesh = working_eye();
  for (int k : not_empty(nodes_of(mesh, "symmetry"))) EXPECT_EQ(mesh.points[k][0], 0);
  for (const Point& p : mesh.points) EXPECT_TRUE(p[0] == 0 || p[0] > 1e-3);
}

TEST(Eye, CavityHoldsFiveAndAHalfMillilitres) {
  const double coarse = cavity(working_eye()), fine = cavity(eye(28)), finest = cavity(eye(56));
  EXPECT_NEAR(2e-3 * fine, 5.5, .05);
  EXPECT_NEAR((fine - coarse) / (finest - fine), 4, 1);  // second order: towards the smooth eye
}

TEST(Eye, SetsAreWhereTheyShouldBe) {
  const Mesh& mesh = working_eye();
  const EyeShape shape;
  const auto at = [&](const char* set) { return mesh.points[mesh.node_sets.at(set).at(0)]; };
  EXPECT_NEAR(norm(at("apex") - Point{0, 0, shape.place(shape.meridian_end(), 0).z}), 0, 1e-12);
  EXPECT_NEAR(norm(at("retina_pole") - Point{0, 0, -10.5}), 0, 1e-12);
  for (int k : not_empty(mesh.node_sets.at("nerve_end"))) EXPECT_EQ(mesh.points[k][2], -20);
  for (int k : not_empty(mesh.node_sets.at("nerve_ring"))) EXPECT_NEAR(norm(mesh.points[k]), 12, 1e-12);
  double low = 0, high = 0;
  for (int k : not_empty(mesh.node_sets.at("equator_band"))) {
    EXPECT_NEAR(norm(mesh.points[k]), 12, 1e-12);
    low = std::min(low, mesh.points[k][2]);
    high = std::max(high, mesh.points[k][2]);
  }
  EXPECT_NEAR(low, -1, 1e-12);
  EXPECT_NEAR(high, 1, 1e-12);
}

// Scenes hold the equator's nodes: there are some at every n, with all widths of the band.
TEST(Eye, TheEquatorIsARingOfNodes) {
  for (int n = 4; n <= 30; n += 2)
    for (double half : {.4, .75, 1., 2.}) {
      EyeSettings settings;
      settings.n = n;
      settings.band_half_width = half;
      const Mesh mesh = generate(settings);
      ASSERT_TRUE(mesh.node_sets.contains("equator")) << n << ' ' << half;
      EXPECT_GE(static_cast<int>(mesh.node_sets.at("equator").size()), n) << half;
    }
}

TEST(Eye, LayersHaveTheirThickness) {
  const EyeShape shape;
  const Mesh& mesh = working_eye();
  double inner = 0;
  for (int k : nodes_of(mesh, "inner_retina"))
    if (std::abs(mesh.points[k][2]) < 1e-9) inner = norm(mesh.points[k]);
  EXPECT_NEAR(inner, 12 - .45 - .17 - .15, 1e-12);
  EXPECT_NEAR(shape.limbus(), 151.1, .1);
  EXPECT_NEAR(shape.wall(shape.meridian_end()), .54, 1e-12);
  EXPECT_NEAR(shape.wall(shape.limbus() + 1e-9), shape.wall(shape.limbus()), 1e-6);
  EXPECT_NEAR(shape.lens_top(0) - shape.lens_bottom(0), 4, 1e-12);
  EXPECT_NEAR(shape.lens_top(4.6) - shape.lens_bottom(4.6), shape.lens_rim, 1e-12);
}

TEST(Eye, LensTouchesNothing) {
  const Mesh& mesh = working_eye();
  const std::vector<int> lens = nodes_of(mesh, "lens");
  for (const std::string& other : mesh.region_names) {
    if (other == "lens") continue;
    double gap = 100;
    for (int k : nodes_of(mesh, other))
      for (int l : lens) gap = std::min(gap, norm(mesh.points[k] - mesh.points[l]));
    EXPECT_GT(gap, 1) << other;
    EXPECT_LT(gap, 100) << other;
  }
}

TEST(Zonules, NumberAndPlaceDoNotDependOnTheMesh) {
  const Mesh& coarse = working_eye();
  const Mesh fine = eye(28);
  const std::vector<Bar>&a = coarse.bars.at("zonules"), &b = fine.bars.at("zonules");
  ASSERT_EQ(a.size(), 241u);
  ASSERT_EQ(b.size(), 241u);
  double share = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    share += a[i].share;
    EXPECT_LT(norm(position(coarse, a[i].a) - position(fine, b[i].a)), .1);
    EXPECT_LT(norm(position(coarse, a[i].b) - position(fine, b[i].b)), .25);
    EXPECT_GT(norm(position(coarse, a[i].b) - position(coarse, a[i].a)), 1);
  }
  EXPECT_EQ(share, 240);
}

TEST(Zonules, OfHalfShareLieOnTheSymmetryPlane) {
  const Mesh& mesh = working_eye();
  int half = 0;
  for (const Bar& bar : not_empty(mesh.bars.at("zonules"))) {
    for (const EmbeddedPoint* e : {&bar.a, &bar.b}) {
      EXPECT_NEAR(std::accumulate(e->weights.begin(), e->weights.end(), 0.0), 1, 1e-14);
      if (bar.share == .5)
        EXPECT_EQ(position(mesh, *e)[0], 0);
      else
        EXPECT_GT(position(mesh, *e)[0], 0);
    }
    half += bar.share == .5;
  }
  EXPECT_EQ(half, 2);
}

/// Σ g gᵀ over the bars, g the elongation by a unit shift in y and z and a unit turn about x through the
/// lens's centre: no rigid motion that the symmetry allows is free.
TEST(Zonules, HoldEveryRigidMotionOfTheLens) {
  const Mesh& mesh = working_eye();
  const Point middle{0, 0, 7.5};
  double k[3][3]{};
  for (const Bar& bar : mesh.bars.at("zonules")) {
    const Point a = position(mesh, bar.a), d = position(mesh, bar.b) - a;
    const Point n = 1 / norm(d) * d, turn = cross(Point{1, 0, 0}, a - middle);
    const double g[3] = {n[1], n[2], dot(turn, n)};
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) k[i][j] += bar.share * g[i] * g[j];
  }
  const double det =
      dot({k[0][0], k[0][1], k[0][2]}, cross(Point{k[1][0], k[1][1], k[1][2]}, {k[2][0], k[2][1], k[2][2]}));
  EXPECT_GT(det, 1e-3 * k[0][0] * k[1][1] * k[2][2]);
  for (int i = 0; i < 3; ++i) EXPECT_GT(k[i][i], 1);
}

TEST(Eye, RefusesWhatDoesNotFit) {
  EyeSettings settings;
  settings.n = 9;
  EXPECT_THROW(generate(settings), InputError);
  settings = {};
  settings.shape.lens_diameter = 25;
  EXPECT_THROW(generate(settings), InputError);
  settings = {};
  settings.shape.ciliary_end = 160;
  EXPECT_THROW(generate(settings), InputError);
  settings = {};
  settings.shape.retina.value.pop_back();
  EXPECT_THROW(generate(settings), InputError);
}

}  // namespace
}  // namespace bulbus
