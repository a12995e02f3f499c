#include <gtest/gtest.h>

#include <cmath>

#include "core/base/error.hpp"
#include "core/mesh/faces.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/quality.hpp"
#include "tests/support/refusal.hpp"

namespace bulbus {
namespace {

Mesh block(int nx, int ny, int nz) {
  BlockShape shape;
  shape.upper = {1, 2, 3};
  shape.nx = nx, shape.ny = ny, shape.nz = nz;
  return generate(shape);
}

TEST(Faces, OfACubePointOutwards) {
  const Mesh mesh = block(1, 1, 1);
  for (const auto& f : hex_faces) {
    Point middle{}, x[4];
    for (int c = 0; c < 4; ++c) middle = middle + .25 * (x[c] = mesh.points[mesh.hexes[0][f[c]]]);
    EXPECT_GT(dot(cross(x[1] - x[0], x[3] - x[0]), middle - center(mesh, 0)), 0);
  }
}

TEST(Faces, BoundaryOfABlock) {
  const Mesh mesh = block(2, 3, 4);
  std::vector<int> owner;
  const std::vector<Quad> faces = boundary_faces(mesh, &owner);
  EXPECT_EQ(faces.size(), 2u * (2 * 3 + 3 * 4 + 4 * 2));
  ASSERT_EQ(owner.size(), faces.size());
  Point volume{};
  for (const Quad& q : faces) volume = volume + volume_flux(corners(mesh, q));
  for (double v : volume) EXPECT_NEAR(v, 6, 1e-12);
}

TEST(Faces, AreFoundByNodesInAnyOrder) {
  const Mesh mesh = block(2, 1, 1);
  const FaceTable table(mesh.hexes);
  const Quad inner = face_nodes(mesh.hexes, 3);  // +x of the first cell
  EXPECT_EQ(table.first({inner[2], inner[0], inner[3], inner[1]}), 3);
  EXPECT_EQ(table.count(inner), 2);
  EXPECT_EQ(table.first({0, 1, 2, 11}), -1);
  EXPECT_EQ(table.first({100, 101, 102, 103}), -1);
}

TEST(Names, FindSetsSurfacesAndRegions) {
  Mesh mesh = block(2, 1, 1);
  mesh.node_sets["pair"] = {5, 0};
  EXPECT_EQ(nodes_of(mesh, "pair"), (std::vector<int>{0, 5}));
  EXPECT_EQ(nodes_of(mesh, "xmin").size(), 4u);
  EXPECT_EQ(nodes_of(mesh, "block").size(), mesh.points.size());
  EXPECT_EQ(region_index(mesh, "block"), 0);
  EXPECT_EQ(region_index(mesh, "none"), -1);
}

TEST(Names, OfSeveralKindsHaveToHaveEqualNodes) {
  Mesh mesh = block(2, 1, 1);
  mesh.node_sets["xmin"] = nodes_of(mesh, "xmin");
  EXPECT_EQ(nodes_of(mesh, "xmin").size(), 4u);
  mesh.node_sets["xmin"].pop_back();
  test::expect_refusal([&] { nodes_of(mesh, "xmin"); },
                       {"'xmin' is a node set of 3 nodes and a surface of 4 nodes", "Rename"});
  mesh.surfaces["block"] = mesh.surfaces["xmax"];
  test::expect_refusal([&] { nodes_of(mesh, "block"); }, {"a surface of 4 nodes and a region of 12 nodes"});
  mesh.surfaces["block"].clear();  // as on a rank without faces of it
  EXPECT_EQ(nodes_of(mesh, "block").size(), 12u);
}

TEST(Names, UnknownOnesGiveTheNearest) {
  const Mesh mesh = block(1, 1, 1);
  try {
    nodes_of(mesh, "xmim");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("did you mean 'xmin'"), std::string::npos) << e.what();
  }
}

TEST(Quality, OfCubesIsOne) {
  const Mesh mesh = block(2, 2, 2);
  const RegionQuality q = quality(mesh).at(0);
  EXPECT_EQ(q.count, 8);
  EXPECT_NEAR(q.volume, 6, 1e-12);
  EXPECT_NEAR(q.least, 1, 1e-12);
  EXPECT_NEAR(q.mean, 1, 1e-12);
  EXPECT_NO_THROW(refuse_inverted(mesh));
}

TEST(Quality, OfAShearedCellIsTheCosine) {
  Mesh mesh = block(1, 1, 1);
  for (Point& p : mesh.points) p = {p[0] + p[2] / 3, p[1] / 2, p[2] / 3};
  EXPECT_NEAR(scaled_jacobian(mesh, 0), std::cos(std::atan(1.0)), 1e-12);
}

TEST(Quality, InvertedCellsAreNamed) {
  Mesh mesh = block(2, 1, 1);
  const Hex h = mesh.hexes[1];
  mesh.hexes[1] = {h[4], h[5], h[6], h[7], h[0], h[1], h[2], h[3]};
  try {
    refuse_inverted(mesh);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("hexahedron 2 of region 'block' about (0.75, 1, 1.5) mm"),
              std::string::npos)
        << e.what();
  }
}

TEST(Quality, AllInvertedCellsAreNamedWorstFirst) {
  Mesh mesh = block(3, 1, 1);
  const Hex g = mesh.hexes[0], h = mesh.hexes[2];
  mesh.hexes[2] = {h[4], h[5], h[6], h[7], h[0], h[1], h[2], h[3]};
  mesh.hexes[0][1] = g[0];  // flat
  try {
    refuse_inverted(mesh);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("hexahedron 3 of region 'block'"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("so are 1 others, worst first: 1 (0)"), std::string::npos)
        << e.what();
  }
}

TEST(Geometry, VolumeOfATrilinearCellIsTheFluxThroughItsFaces) {
  Mesh mesh = block(1, 1, 1);
  mesh.points[7] = {1.2, 2.3, 3.4};  // twisted: none of its faces there is plane
  Point flux{};
  for (const Quad& q : boundary_faces(mesh)) flux = flux + volume_flux(corners(mesh, q));
  for (double v : flux) EXPECT_NEAR(v, hex_volume(mesh, 0), 1e-12);
}

TEST(Geometry, ProjectionStaysInTheQuad) {
  const std::array<Point, 4> quad{{{0, 0, 0}, {2, 0, 0}, {2.5, 1, 0}, {0, 1, 0}}};
  const Projection inside = project({1, .25, 4}, quad);
  EXPECT_NEAR(inside.distance, 4, 1e-12);
  EXPECT_NEAR(norm(inside.point - Point{1, .25, 0}), 0, 1e-9);
  const Projection beyond = project({-1, -1, 0}, quad);
  EXPECT_EQ(beyond.weights[0], 1);
  EXPECT_NEAR(beyond.distance, std::sqrt(2), 1e-12);
}

}  // namespace
}  // namespace bulbus
