#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "app/eye/eye.hpp"
#include "core/base/error.hpp"
#include "core/mesh/generate/embed.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/quality.hpp"
#include "core/mesh/refine.hpp"
#include "tests/support/not_empty.hpp"

namespace bulbus {
namespace {

constexpr double degree = std::numbers::pi / 180;

EyeSettings settings(int n, bool torn, double height = 1.25) {
  EyeSettings s;
  s.n = n;
  s.detachment.emplace().height = height;
  if (torn) s.detachment->tear.emplace();
  return s;
}

const Mesh& attached_eye() {
  static const Mesh mesh = generate(EyeSettings{});
  return mesh;
}
const Mesh& detached_eye() {
  static const Mesh mesh = generate(settings(14, false));
  return mesh;
}
const Mesh& torn_eye() {
  static const Mesh mesh = generate(settings(14, true));
  return mesh;
}

/// Its tear has the edges of whole cells, so that none is moved.
Mesh torn_along_lines() {
  EyeSettings s = settings(14, true);
  const EyeShape e;
  const double radius = e.sclera_radius - e.wall(90) - e.choroid(90);
  s.detachment->tear->length = 2 * radius * std::asin(1.0 / 12);
  s.detachment->tear->width = 2 * radius * degree * 180 / 28;
  return generate(s);
}

double polar(const Point& p) { return std::acos(-p[2] / norm(p)) / degree; }
double azimuth(const Point& p) { return std::atan2(p[0], p[1]) / degree; }

/// mm³ on the side that the normals point to.
double enclosed(const Mesh& mesh, std::initializer_list<const char*> surfaces) {
  double sum = 0;
  for (const char* name : surfaces)
    for (const Quad& q : mesh.surfaces.at(name)) sum -= volume_flux(corners(mesh, q))[0];
  return sum;
}

using Edges = std::map<std::pair<int, int>, int>;

Edges directed_edges(const Mesh& mesh, const char* surface) {
  Edges edges;
  for (const Quad& q : mesh.surfaces.at(surface))
    for (int c = 0; c < 4; ++c) ++edges[{q[c], q[(c + 1) % 4]}];
  return edges;
}

/// Edges without a neighbour that runs the other way, those on x = 0 left out.
std::vector<std::pair<int, int>> open_edges(const Mesh& mesh, const char* surface) {
  const Edges edges = directed_edges(mesh, surface);
  std::vector<std::pair<int, int>> open;
  for (const auto& [e, count] : not_empty(edges)) {
    EXPECT_EQ(count, 1);
    const bool cut = mesh.points[e.first][0] == 0 && mesh.points[e.second][0] == 0;
    if (!cut && !edges.count({e.second, e.first})) open.push_back(e);
  }
  return open;
}

TEST(EyeDetachment, IsAbsentByDefault) {
  const Mesh& mesh = attached_eye();
  EXPECT_EQ(mesh.hexes.size(), 7350u);
  EXPECT_EQ(mesh.points.size(), 9210u);
  for (const char* name : {"retina_back", "retina_bed"}) EXPECT_EQ(mesh.surfaces.count(name), 0u) << name;
  for (const char* name : {"detached", "detached_bed", "tear_rim"})
    EXPECT_EQ(mesh.node_sets.count(name), 0u) << name;
}

TEST(EyeDetachment, DoublesNodesAndLeavesTheTornCellsOut) {
  const Mesh &whole = detached_eye(), &torn = torn_eye();
  EXPECT_EQ(whole.hexes.size(), 7350u);
  EXPECT_EQ(whole.points.size(), 9210 + whole.node_sets.at("detached").size());
  EXPECT_EQ(whole.surfaces.at("retina_back").size(), whole.surfaces.at("retina_bed").size());
  EXPECT_EQ(whole.surfaces.at("inner_retina").size(), attached_eye().surfaces.at("inner_retina").size());
  EXPECT_EQ(whole.node_sets.count("tear_rim"), 0u);

  const std::size_t columns = 4;  // 1.28 mm in azimuth, 1.9 mm along the meridian
  EXPECT_EQ(torn.hexes.size(), 7350 - 2 * columns);
  EXPECT_EQ(torn.surfaces.at("retina_bed").size(), whole.surfaces.at("retina_bed").size());
  EXPECT_EQ(torn.surfaces.at("retina_back").size(), whole.surfaces.at("retina_back").size() - columns);
  EXPECT_EQ(torn.surfaces.at("inner_retina").size(), whole.surfaces.at("inner_retina").size() - columns);
  std::set<int> used;
  for (const Hex& h : torn.hexes) used.insert(h.begin(), h.end());
  EXPECT_EQ(used.size(), torn.points.size());
}

TEST(EyeDetachment, LiftsItsNodesOffTheirTwinsByTheFormula) {
  for (int n : {8, 14, 28}) {
    const EyeSettings s = settings(n, true);
    const Mesh mesh = generate(s);
    const std::vector<int>&back = mesh.node_sets.at("detached"), &bed = mesh.node_sets.at("detached_bed");
    ASSERT_EQ(back.size(), bed.size());
    EXPECT_TRUE(std::is_sorted(back.begin(), back.end()));
    EXPECT_TRUE(std::is_sorted(bed.begin(), bed.end()));
    for (std::size_t i = 0; i < back.size(); ++i) {
      const Point &p = mesh.points[back[i]], &q = mesh.points[bed[i]];
      const double lift = s.detachment->lift(polar(q), azimuth(q));
      EXPECT_GT(lift, 0);
      EXPECT_NEAR(norm(q - p), lift, 1e-12);
      EXPECT_NEAR(norm(q) - norm(p), lift, 1e-12);
      EXPECT_EQ(p[0] == 0, q[0] == 0);
    }
  }
}

TEST(EyeDetachment, NamesTheBedUnderBothEdgesOfTheTear) {
  const Mesh& mesh = torn_eye();
  const auto range = [&](const char* set) {
    std::vector<double> t;
    for (int k : not_empty(mesh.node_sets.at(set))) t.push_back(polar(mesh.points[k]));
    return std::ranges::minmax(t);
  };
  const auto rim = range("tear_rim"), front = range("tear_bed_front"), back = range("tear_bed_back");
  EXPECT_NEAR(front.min, rim.max, 1e-9);
  EXPECT_NEAR(front.max, rim.max, 1e-9);
  EXPECT_NEAR(back.max, rim.min, 1e-9);
  const std::vector<int>& bed = mesh.node_sets.at("detached_bed");
  for (const char* set : {"tear_bed_front", "tear_bed_back"})
    for (int k : mesh.node_sets.at(set)) EXPECT_TRUE(std::ranges::binary_search(bed, k)) << set;
}

TEST(EyeDetachment, LeavesTheRetinaAttachedWhereTheLiftIsZero) {
  const Mesh& mesh = torn_eye();
  const Detachment d;
  std::vector<int> shared;
  std::ranges::set_intersection(nodes_of(mesh, "retina"), nodes_of(mesh, "choroid"),
                                std::back_inserter(shared));
  for (int k : not_empty(shared)) EXPECT_EQ(d.lift(polar(mesh.points[k]), azimuth(mesh.points[k])), 0);
  for (int k : not_empty(mesh.node_sets.at("detached"))) EXPECT_FALSE(std::ranges::binary_search(shared, k));
}

TEST(EyeDetachment, KeepsTheThicknessOfTheRetina) {
  const Mesh& mesh = torn_eye();
  const EyeShape e;
  const Detachment d;
  for (int k : not_empty(nodes_of(mesh, "inner_retina"))) {
    const Point& p = mesh.points[k];
    const double t = polar(p), depth = e.wall(t) + e.choroid(t) + e.retina(t) + d.lift(t, azimuth(p));
    EXPECT_NEAR(norm(p), e.sclera_radius - depth, 1e-9);
  }
}

TEST(EyeDetachment, WetSurfaceIsClosedUpToTheSymmetryPlane) {
  for (int n : {4, 6, 8, 10, 14, 20, 28})
    for (bool torn : {false, true})
      EXPECT_TRUE(open_edges(generate(settings(n, torn)), "cavity").empty()) << "n = " << n;
}

TEST(EyeDetachment, LiquidAndTissueTogetherKeepTheirVolume) {
  const std::vector<RegionQuality> before = quality(attached_eye());
  double filled = enclosed(attached_eye(), {"cavity"});
  for (const RegionQuality& q : before) filled += q.volume;
  const Mesh torn = torn_along_lines();
  for (const Mesh* mesh : {&detached_eye(), &torn}) {
    double sum = enclosed(*mesh, {"cavity"});
    for (const RegionQuality& q : quality(*mesh)) sum += q.volume;
    EXPECT_NEAR(sum, filled, 1e-9);
  }
  const std::vector<RegionQuality> after = quality(detached_eye());
  for (std::size_t r = 0; r < after.size(); ++r)
    EXPECT_NEAR(after[r].volume / before[r].volume, 1, after[r].region == "retina" ? .015 : 1e-14)
        << after[r].region;  // the lifted retina lies on a smaller sphere
}

TEST(EyeDetachment, GapHoldsTheVolumeOfTheFormula) {
  const EyeShape e;
  const Detachment d;
  double exact = 0;
  const int m = 400;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) {
      const double t = d.center + d.half_length * (2 * (i + .5) / m - 1), phi = d.half_width * (j + .5) / m;
      const double r = e.sclera_radius - e.wall(t) - e.choroid(t), s = r - d.lift(t, phi);
      exact += (r * r * r - s * s * s) / 3 * std::sin(t * degree);
    }
  exact *= 2 * d.half_length * d.half_width * degree * degree / (m * m);
  const double coarse = enclosed(detached_eye(), {"retina_back", "retina_bed"});
  const double fine = enclosed(generate(settings(28, false)), {"retina_back", "retina_bed"});
  EXPECT_NEAR(coarse / exact, 1, .06);
  EXPECT_NEAR(fine / exact, 1, .015);
}

TEST(EyeDetachment, RimIsTheEdgeOfTheHole) {
  const Mesh& mesh = torn_eye();
  const std::vector<int>&rim = mesh.node_sets.at("tear_rim"), &detached = mesh.node_sets.at("detached");
  EXPECT_TRUE(std::ranges::includes(detached, rim));
  std::set<int> met;
  for (const auto& [a, b] : open_edges(mesh, "retina_back")) {
    if (!std::ranges::binary_search(detached, a) || !std::ranges::binary_search(detached, b)) continue;
    met.insert(a), met.insert(b);
  }
  EXPECT_EQ(std::vector<int>(met.begin(), met.end()), rim);
}

// As it lies on its bed: in the whole eye 2.6 mm wide through its center and 2 mm long, on every mesh.
TEST(Tear, HasTheSizeThatIsAskedFor) {
  const EyeShape e;
  for (double center : {90., 98.})
    for (int n : {8, 10, 14, 20}) {
      EyeSettings s = settings(n, true);
      s.detachment->tear->center = center;
      const double radius = e.sclera_radius - e.wall(center) - e.choroid(center);
      const double half_length = 1 / radius / degree,
                   half_width = 1.3 / radius / std::sin(center * degree) / degree;
      const Mesh coarse = generate(s), fine = refine(coarse).mesh;
      for (const Mesh* mesh : {&coarse, &fine})
        for (int k : not_empty(mesh->node_sets.at("tear_rim"))) {
          const double t = std::abs(polar(mesh->points[k]) - center), phi = azimuth(mesh->points[k]);
          EXPECT_LT(phi, half_width + 1e-9) << n;
          EXPECT_LT(t, half_length + 1e-9) << n;
          EXPECT_TRUE(phi > half_width - 1e-9 || t > half_length - 1e-9) << n;
        }
      EXPECT_EQ(unlike_tear(s), "");
      for (int k : not_empty(coarse.node_sets.at("equator"))) EXPECT_NEAR(coarse.points[k][2], 0, 1e-12);
    }
}

TEST(EyeDetachment, TearHasOneCellAtLeast) {
  EyeSettings s = settings(14, true);
  s.detachment->tear->width = s.detachment->tear->length = .01;
  const Mesh mesh = generate(s);
  EXPECT_EQ(mesh.surfaces.at("retina_bed").size(), mesh.surfaces.at("retina_back").size() + 1);
  EXPECT_EQ(mesh.node_sets.at("tear_rim").size(), 4u);
}

TEST(EyeDetachment, IsRegularAtEveryN) {
  for (int n : {8, 14, 28})
    for (double height : {1.25, 3.0}) {
      const Mesh mesh = generate(settings(n, true, height));
      // at n = 8 columns 11 degrees wide are moved by 5 of them to the tear's edge
      const double least = n == 8 ? .6 : height < 2 ? .85 : .7;
      EXPECT_GT(quality(mesh)[region_index(mesh, "retina")].least, least) << "n = " << n;
    }
}

TEST(EyeDetachment, IsTheSameEveryTime) {
  const Mesh again = generate(settings(14, true));
  EXPECT_EQ(again.points, torn_eye().points);
  EXPECT_EQ(again.hexes, torn_eye().hexes);
  EXPECT_EQ(again.surfaces, torn_eye().surfaces);
  EXPECT_EQ(again.node_sets, torn_eye().node_sets);
}

TEST(EyeDetachment, LeavesTheZonulesWhereTheyAre) {
  const std::vector<Bar>&a = attached_eye().bars.at("zonules"), &b = torn_eye().bars.at("zonules");
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(position(attached_eye(), a[i].a), position(torn_eye(), b[i].a));
    EXPECT_EQ(position(attached_eye(), a[i].b), position(torn_eye(), b[i].b));
  }
}

/// The message must hold `word`.
void expect_refusal(const EyeSettings& s, const std::string& word) {
  try {
    generate(s);
    ADD_FAILURE() << "not refused: " << word;
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
  }
}

TEST(EyeDetachment, RefusesWhatDoesNotFit) {
  EyeSettings s = settings(14, false);
  s.detachment->half_width = -50;
  expect_refusal(s, "half_width -50");
  s = settings(14, false, 0);
  expect_refusal(s, "height 0");
  s = settings(14, false);
  s.detachment->center = 100;
  expect_refusal(s, "beyond the retina");
  s = settings(14, false, 11.5);
  expect_refusal(s, "the globe's centre");
  s = settings(14, false);
  s.detachment->half_length = s.detachment->half_width = 1;
  s.detachment->center = 89;
  expect_refusal(s, "no node");
  s = settings(14, true);
  s.detachment->tear->center = 60;
  expect_refusal(s, "attached");
  s = settings(14, true);
  s.detachment->tear->width = 25;
  expect_refusal(s, "attached");
  s = settings(14, true);
  s.detachment->tear->length = -2;
  expect_refusal(s, "length -2");
}

TEST(EyeDetachment, RefusesARetinaThatReachesTheLens) {
  EyeSettings s = settings(14, false);
  s.shape.lens_diameter = 14, s.shape.lens_depth = 9;
  EXPECT_NO_THROW(generate(s));
  s.detachment->height = 7;
  expect_refusal(s, "the lens");
}

TEST(Tear, OfAnotherSizeThanAskedForIsTold) {
  EyeSettings s = settings(8, true);
  s.detachment->tear->width = .5;
  EXPECT_NE(unlike_tear(s).find("mm are asked for: it is made of whole cells"), std::string::npos);
  EXPECT_EQ(unlike_tear(settings(16, true)), "");
  EXPECT_EQ(unlike_tear(settings(8, false)), "");
}

TEST(Zonules, StayOnTheirTissues) {
  const auto refused = [](auto change) {
    EyeSettings s;
    change(s);
    EXPECT_THROW(generate(s), InputError);
  };
  refused([](EyeSettings& s) { s.zonules.equatorial_from = 100; });
  refused([](EyeSettings& s) { s.zonules.posterior_from = 141; });
  refused([](EyeSettings& s) { s.shape.ciliary_end = 128; });
  refused([](EyeSettings& s) { s.zonules.anterior_inset = 6; });
}

}  // namespace
}  // namespace bulbus
