#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/eye/eye.hpp"
#include "core/mesh/generate/embed.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/quality.hpp"
#include "core/mesh/refine.hpp"
#include "tests/support/not_empty.hpp"

namespace bulbus {
namespace {

double refined_volume(const Mesh& mesh) {
  double sum = 0;
  for (int h = 0; h < static_cast<int>(mesh.hexes.size()); ++h) sum += hex_volume(mesh, h);
  return sum;
}

EyeSettings eye(int n) {
  EyeSettings s;
  s.n = n;
  return s;
}

// The largest distance of a node of `a` from the nearest node of `b`, of one region.
double distance(const Mesh& a, const Mesh& b, int region) {
  std::vector<Point> sorted;
  for (int n : nodes_of_region(b, region)) sorted.push_back(b.points[n]);
  std::sort(sorted.begin(), sorted.end());
  double largest = 0;
  for (int n : nodes_of_region(a, region)) {
    const Point& p = a.points[n];
    double nearest = 1e300;
    for (auto at = std::lower_bound(sorted.begin(), sorted.end(), Point{p[0] - 1e-6, -1e300, -1e300});
         at != sorted.end() && (*at)[0] < p[0] + 1e-6; ++at)
      nearest = std::min(nearest, norm(p - *at));
    largest = std::max(largest, nearest);
  }
  return largest;
}

// Surfaces are those of the boundary, whichever mesh they were named in.
void expect_boundary(const Mesh& mesh) {
  std::set<Quad> boundary;
  for (Quad q : boundary_faces(mesh)) {
    std::rotate(q.begin(), std::min_element(q.begin(), q.end()), q.end());
    boundary.insert(q);
  }
  for (const auto& [name, faces] : not_empty(mesh.surfaces))
    for (Quad q : faces) {
      std::rotate(q.begin(), std::min_element(q.begin(), q.end()), q.end());
      ASSERT_TRUE(boundary.contains(q)) << name;
    }
}

TEST(Refine, OfABlockIsTheFinerBlock) {
  const Mesh coarse = generate(BlockShape{.upper = {1, 2, 3}, .nx = 2, .ny = 3, .nz = 1});
  const RefinedMesh r = refine(coarse);
  const Mesh finer = generate(BlockShape{.upper = {1, 2, 3}, .nx = 4, .ny = 6, .nz = 2});
  EXPECT_EQ(r.mesh.hexes.size(), finer.hexes.size());
  EXPECT_EQ(r.mesh.points.size(), finer.points.size());
  EXPECT_LT(distance(r.mesh, finer, 0), 1e-15);
  EXPECT_NEAR(refined_volume(r.mesh), 6, 1e-13);
  for (const auto& [name, faces] : not_empty(finer.surfaces))
    EXPECT_EQ(r.mesh.surfaces.at(name).size(), faces.size()) << name;
  expect_boundary(r.mesh);
  for (int n : not_empty(nodes_of(r.mesh, "xmax"))) EXPECT_EQ(r.mesh.points[n][0], 1);
}

TEST(Refine, ChildrenHaveTheirParentsCorners) {
  const Mesh coarse = generate(BallShape{});
  const RefinedMesh r = refine(coarse);
  for (std::size_t h = 0; h < coarse.hexes.size(); ++h)
    for (int c = 0; c < 8; ++c) EXPECT_EQ(r.mesh.hexes[8 * h + c][c], coarse.hexes[h][c]);
  for (int n = 0; n < static_cast<int>(coarse.points.size()); ++n)
    EXPECT_EQ(r.mesh.points[n], coarse.points[n]);
  for (std::size_t h = 0; h < r.mesh.hexes.size(); ++h) EXPECT_GT(hex_volume(r.mesh, static_cast<int>(h)), 0);
}

TEST(Refine, OfCurvedShapesIsTheFinerShape) {
  const auto check = [](const Mesh& refined, const Mesh& finer) {
    ASSERT_EQ(refined.points.size(), finer.points.size());
    EXPECT_LT(distance(refined, finer, 0), 1e-14);
    for (const auto& [name, faces] : not_empty(finer.surfaces))
      EXPECT_EQ(refined.surfaces.at(name).size(), faces.size()) << name;
    for (const auto& [name, set] : finer.node_sets)  // some shapes have none
      EXPECT_EQ(refined.node_sets.at(name).size(), set.size()) << name;
    expect_boundary(refined);
  };
  check(refine(generate(ShellShape{.n = 3, .layers = 1, .part = "half"})).mesh,
        generate(ShellShape{.n = 6, .layers = 2, .part = "half"}));
  check(refine(generate(BallShape{.n = 2, .layers = 3})).mesh, generate(BallShape{.n = 4, .layers = 6}));
  check(refine(generate(CylinderShape{.n = 2, .rings = 1, .layers = 2})).mesh,
        generate(CylinderShape{.n = 4, .rings = 2, .layers = 4}));
}

TEST(Refine, OfTheEyeIsTheFinerEye) {
  const Mesh refined = refine(generate(eye(14))).mesh, finer = generate(eye(28));
  ASSERT_EQ(refined.hexes.size(), finer.hexes.size());
  ASSERT_EQ(refined.points.size(), finer.points.size());
  for (std::size_t r = 0; r < finer.region_names.size(); ++r)
    EXPECT_LT(distance(refined, finer, static_cast<int>(r)), 1e-12) << finer.region_names[r];
  for (const auto& [name, faces] : not_empty(finer.surfaces))
    EXPECT_EQ(refined.surfaces.at(name).size(), faces.size()) << name;
  for (const char* name : {"apex", "retina_pole", "equator_band", "nerve_end"})
    EXPECT_EQ(refined.node_sets.at(name).size(), finer.node_sets.at(name).size()) << name;
  expect_boundary(refined);
  for (int n : not_empty(nodes_of(refined, "symmetry"))) EXPECT_EQ(refined.points[n][0], 0);
}

TEST(Refine, BarsKeepTheirEnds) {
  const Mesh coarse = generate(eye(8)), fine = refine(coarse).mesh;
  const auto &before = coarse.bars.at("zonules"), &after = fine.bars.at("zonules");
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(before[i].share, after[i].share);
    for (auto [a, b] : {std::pair{&before[i].a, &after[i].a}, {&before[i].b, &after[i].b}}) {
      EXPECT_LT(norm(position(coarse, *a) - position(fine, *b)),
                .2);  // the new face is nearer to the curved surface
      EXPECT_EQ(position(coarse, *a)[0] == 0, position(fine, *b)[0] == 0);
    }
  }
}

TEST(Refine, BarsOnFlatFacesStayWhereTheyAre) {
  Mesh mesh = generate(BlockShape{.nx = 2, .ny = 2, .nz = 2});
  const EmbeddedPoint a = embed(mesh, mesh.surfaces.at("xmax"), {1, .3, .85}).point, b = at_node(0);
  mesh.bars["strings"] = {{a, b, .5}};
  const Mesh fine = refine(refine(mesh).mesh).mesh;
  EXPECT_LT(norm(position(fine, fine.bars.at("strings")[0].a) - Point{1, .3, .85}), 1e-14);
  EXPECT_EQ(sole_node(fine.bars.at("strings")[0].b), 0);
}

TEST(Refine, DetachedRetinaStaysDetached) {
  EyeSettings s = eye(8);
  s.detachment = Detachment{.tear = Tear{}};
  const Mesh coarse = generate(s), fine = refine(coarse).mesh;
  EXPECT_EQ(fine.surfaces.at("retina_back").size(), 4 * coarse.surfaces.at("retina_back").size());
  expect_boundary(fine);
  const auto &detached = fine.node_sets.at("detached"), &bed = fine.node_sets.at("detached_bed");
  ASSERT_EQ(detached.size(), bed.size());
  EXPECT_GT(detached.size(), 2 * coarse.node_sets.at("detached").size());
  for (std::size_t i = 0; i < bed.size(); ++i) {
    const Point gap = fine.points[bed[i]] - fine.points[detached[i]];
    EXPECT_GT(norm(gap), 0);
    EXPECT_LT(norm(gap - (norm(gap) / norm(fine.points[bed[i]])) * fine.points[bed[i]]),
              1e-12);  // along the globe's radius
  }
  for (const RegionQuality& q : not_empty(quality(fine))) EXPECT_GT(q.least, .3) << q.region;
}

TEST(Refine, NewNodesLieOnTheAnalyticSurfaces) {
  const EyeShape shape;
  const Mesh fine = refine(refine(generate(eye(4))).mesh).mesh;
  for (int n : not_empty(nodes_of(fine, "outer_sclera")))
    EXPECT_NEAR(norm(fine.points[n]), shape.sclera_radius, 1e-12);
  for (int n : not_empty(nodes_of(fine, "lens_surface"))) {
    const Point& p = fine.points[n];
    const double rho = std::hypot(p[0], p[1]);
    if (rho > .5 * shape.lens_diameter - 1e-9) continue;
    EXPECT_LT(std::min(std::abs(p[2] - shape.lens_top(rho)), std::abs(p[2] - shape.lens_bottom(rho))), 1e-12);
  }
}

}  // namespace
}  // namespace bulbus
