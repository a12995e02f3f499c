#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/quality.hpp"
#include "tests/support/not_empty.hpp"

namespace bulbus {
namespace {

using std::numbers::pi;

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const RegionQuality& q : quality(mesh)) sum += q.volume;
  return sum;
}

double enclosed(const Mesh& mesh) {
  double sum = 0;
  for (const Quad& q : boundary_faces(mesh)) sum += volume_flux(corners(mesh, q))[2];
  return sum;
}

/// Error of the volume falls by about 4 when the mesh is halved, and the mesh is watertight and regular.
template <class Shape>
void expect_convergence(Shape coarse, Shape fine, double exact, double least_quality) {
  const Mesh a = generate(coarse), b = generate(fine);
  const double ratio = (exact - volume(a)) / (exact - volume(b));
  EXPECT_NEAR(ratio, 4, .6);
  EXPECT_NEAR(volume(b), enclosed(b), 1e-9 * exact);
  EXPECT_GT(quality(a)[0].least, least_quality);
  EXPECT_GT(quality(b)[0].least, least_quality);
}

TEST(Block, HasSixSides) {
  BlockShape shape;
  shape.lower = {-1, 0, 2}, shape.upper = {1, 1, 5};
  shape.nx = 4, shape.ny = 3, shape.nz = 2;
  const Mesh mesh = generate(shape);
  EXPECT_EQ(mesh.hexes.size(), 24u);
  EXPECT_NEAR(volume(mesh), 6, 1e-12);
  EXPECT_EQ(mesh.surfaces.at("xmin").size(), 6u);
  EXPECT_EQ(mesh.surfaces.at("ymax").size(), 8u);
  EXPECT_EQ(mesh.surfaces.at("zmax").size(), 12u);
  EXPECT_EQ(mesh.surfaces.at("outside").size(), 52u);
}

TEST(Block, RefusesCornersThatAreSwapped) {
  BlockShape shape;
  shape.upper = {1, -1, 1};
  EXPECT_THROW(generate(shape), InputError);
}

TEST(Shell, CountsOfTheVerificationCases) {
  ShellShape shape;
  EXPECT_EQ(generate(shape).hexes.size(), 96u);
  shape.n = 8, shape.layers = 4;
  EXPECT_EQ(generate(shape).hexes.size(), 768u);
}

TEST(Shell, PartsAreFractionsOfTheWhole) {
  ShellShape shape;
  const double octant = volume(generate(shape));
  for (const auto& [part, times] : std::map<std::string, int>{{"quarter", 2}, {"half", 4}, {"whole", 8}}) {
    shape.part = part;
    const Mesh mesh = generate(shape);
    EXPECT_NEAR(volume(mesh), times * octant, 1e-10) << part;
    EXPECT_EQ(mesh.surfaces.at("inner").size(), 48u * times) << part;
    EXPECT_EQ(mesh.surfaces.count("xmin"), part != "whole") << part;
    EXPECT_EQ(mesh.surfaces.count("ymin"), part == "quarter") << part;
  }
}

TEST(Shell, NodesLieOnTheSpheresAndPlanes) {
  const Mesh mesh = generate(ShellShape{});
  for (int k : not_empty(nodes_of(mesh, "inner"))) EXPECT_NEAR(norm(mesh.points[k]), 1, 1e-14);
  for (int k : not_empty(nodes_of(mesh, "outer"))) EXPECT_NEAR(norm(mesh.points[k]), 2, 1e-14);
  for (int k : not_empty(nodes_of(mesh, "zmin"))) EXPECT_EQ(mesh.points[k][2], 0);
}

TEST(Shell, Converges) {
  ShellShape coarse, fine;
  fine.n = 8, fine.layers = 4;
  expect_convergence(coarse, fine, pi / 6 * 7, .8);
}

TEST(Shell, RefusesRadiiThatAreSwapped) {
  ShellShape shape;
  shape.inner = 3;
  EXPECT_THROW(generate(shape), InputError);
}

TEST(Ball, Converges) {
  BallShape coarse, fine;
  coarse.radius = fine.radius = 2;
  fine.n = 8, fine.layers = 8;
  expect_convergence(coarse, fine, pi / 6 * 8, .6);
  const Mesh mesh = generate(coarse);
  for (int k : not_empty(nodes_of(mesh, "outer"))) EXPECT_NEAR(norm(mesh.points[k]), 2, 1e-14);
}

TEST(Ball, WholeIsClosed) {
  BallShape shape;
  shape.part = "whole", shape.n = 2, shape.layers = 2;
  const Mesh mesh = generate(shape);
  EXPECT_EQ(mesh.surfaces.at("outer").size(), boundary_faces(mesh).size());
  EXPECT_EQ(mesh.surfaces.at("outer").size(), 6u * 4 * 4);
}

TEST(Cylinder, Converges) {
  CylinderShape coarse, fine;
  coarse.height = fine.height = 3;
  fine.n = 8, fine.rings = 8;
  expect_convergence(coarse, fine, pi * 3, .8);
}

TEST(Cylinder, IsNamedAllAround) {
  const Mesh mesh = generate(CylinderShape{});
  EXPECT_EQ(mesh.surfaces.at("bottom").size(), mesh.surfaces.at("top").size());
  EXPECT_EQ(mesh.surfaces.at("side").size(), 32u * 4);
  EXPECT_EQ(mesh.node_sets.at("axis").size(), 5u);
  for (int k : not_empty(nodes_of(mesh, "side")))
    EXPECT_NEAR(std::hypot(mesh.points[k][0], mesh.points[k][1]), 1, 1e-14);
  for (int k : not_empty(nodes_of(mesh, "axis")))
    EXPECT_EQ(std::hypot(mesh.points[k][0], mesh.points[k][1]), 0);
}

}  // namespace
}  // namespace bulbus
