#include "core/element/pressure_surface.hpp"

#include <gtest/gtest.h>

#include "core/element/block_csr.hpp"
#include "core/mesh/geometry.hpp"
#include "tests/support/solids.hpp"

namespace bulbus {
namespace {

const Point origin{0, 0, 0};

/// The boundary of a shaken, deformed block of 3×3×2: 42 faces, one pack of them partial.
struct PressureSurfaceTest : testing::Test {
  Mesh mesh = shaken_block(3, 3, 2);
  std::vector<double> X = places(mesh), x = deformed(X, 17), d = noise_vector(X.size(), 3);
  PressureSurface surface{boundary_faces(mesh)};

  std::vector<double> gradient(std::span<const double> at, double factor = 1) const {
    std::vector<double> g(X.size());
    surface.add_gradient(at, factor, g);
    return g;
  }
  std::vector<double> action(const PressureSurface& s, double factor, std::span<const double> dx) const {
    std::vector<double> f(X.size());
    s.add_stiffness(x, factor, dx, f);
    return f;
  }
  double solid_volume(std::span<const double> at) const {
    Mesh moved = mesh;
    for (std::size_t i = 0; i < X.size(); ++i) moved.points[i / 3][i % 3] = at[i];
    double v = 0;
    for (std::size_t h = 0; h < mesh.hexes.size(); ++h) v += hex_volume(moved, static_cast<int>(h));
    return v;
  }
};

// The fluid is outside of the solid: the volume within a solid's own boundary counts as taken from it.
TEST(PressureSurface, VolumeOfACubesBoundaryIsMinusTheCube) {
  const Mesh mesh = generate(BlockShape{.upper = {2, 3, 4}});
  const PressureSurface surface(boundary_faces(mesh));
  EXPECT_NEAR(surface.volume(places(mesh), {5, -1, 2}), -24, 1e-12);
}

TEST(PressureSurface, VolumeOfACavityIsPositive) {
  const Mesh shell = generate(ShellShape{.inner = 1, .outer = 1.5, .n = 8, .layers = 1, .part = "whole"});
  const PressureSurface inner(shell.surfaces.at("inner")), outer(shell.surfaces.at("outer"));
  EXPECT_NEAR(inner.volume(places(shell), origin), 4.18879, .05);
  EXPECT_LT(outer.volume(places(shell), origin), 0);
}

TEST(PressureSurface, OctantClosedBySymmetryPlanesHasAnEighth) {
  const Mesh octant = generate(ShellShape{.n = 4, .layers = 1}),
             whole = generate(ShellShape{.n = 4, .layers = 1, .part = "whole"});
  EXPECT_NEAR(8 * PressureSurface(octant.surfaces.at("inner")).volume(places(octant), origin),
              PressureSurface(whole.surfaces.at("inner")).volume(places(whole), origin), 1e-12);
}

TEST_F(PressureSurfaceTest, ClosedSurfaceHasTheHexahedrasVolumeWhereverTheOriginIs) {
  for (Point x0 : {origin, Point{3, -7, 2}}) EXPECT_NEAR(surface.volume(x, x0), -solid_volume(x), 1e-11);
}

TEST_F(PressureSurfaceTest, GradientIsDerivativeOfVolume) {
  const auto g = gradient(x);
  const auto volume = [&](std::span<const double> at) { return std::vector{surface.volume(at, {1, 2, -3})}; };
  for (std::size_t i = 0; i < X.size(); ++i) {
    std::vector<double> e(X.size());
    e[i] = 1;
    ASSERT_NEAR(g[i], derivative(volume, x, e)[0], 1e-9);
  }
  EXPECT_LT(relative_difference(gradient(x, -2.5), plus(std::vector<double>(X.size()), -2.5, g)), 1e-15);
}

TEST_F(PressureSurfaceTest, StiffnessIsDerivativeOfGradient) {
  const auto expected = derivative([&](std::span<const double> at) { return gradient(at, 1.7); }, x, d);
  EXPECT_LT(relative_difference(action(surface, 1.7, d), expected), 1e-9);
}

TEST_F(PressureSurfaceTest, VisitedMatricesActAsStiffness) {
  const BlockCsr A(static_cast<int>(mesh.points.size()),
                   [&](const ContributionVisitor& v) { surface.visit(x, 1.7, v); });
  std::vector<double> f(X.size());
  A.apply(d, f);
  EXPECT_LT(relative_difference(f, action(surface, 1.7, d)), 1e-13);
}

TEST_F(PressureSurfaceTest, SumOverAClosedSurfaceIsSymmetricButAnOpenOneIsNot) {
  const auto e = noise_vector(X.size(), 4);
  EXPECT_NEAR(inner(action(surface, 1, d), e), inner(action(surface, 1, e), d), 1e-12);
  const PressureSurface open(mesh.surfaces.at("zmax"));
  EXPECT_GT(std::abs(inner(action(open, 1, d), e) - inner(action(open, 1, e), d)), 1e-3);
}

TEST_F(PressureSurfaceTest, NoFaces) {
  const PressureSurface none({});
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.volume(x, origin), 0);
}

// ∫ J dV0 of each trilinear hexahedron is the flux through its six bilinear faces, in value and gradient.
TEST_F(PressureSurfaceTest, FluxThroughAHexahedronsFacesIsItsVolume) {
  Solid solid(X, mesh.hexes, {{"a", make_material({{1, 0, 1}}), 0, 18}});
  const std::vector<double> lambda(18);
  std::vector<double> f(X.size()), volume_error(18);
  solid.residual(x, lambda, f, volume_error);
  tangent_of(solid, x, lambda, 0)
      .visit_constraints([&](int hex, std::span<const int> nodes, std::span<const double> b) {
        std::vector<Quad> faces;
        for (const auto& local : hex_faces) {
          Quad q;
          for (int i = 0; i < 4; ++i) q[i] = mesh.hexes[hex][local[i]];
          faces.push_back(q);
        }
        const PressureSurface boundary(faces);
        EXPECT_NEAR(-boundary.volume(x, origin), volume_error[hex] + solid.reference_volumes()[hex], 1e-13);
        std::vector<double> g(X.size());
        boundary.add_gradient(x, -1, g);
        for (int i = 0; i < 24; ++i) EXPECT_NEAR(g[3 * nodes[i / 3] + i % 3], b[i], 1e-14);
      });
}

// Mean stress −P everywhere balances the pressure P of the fluid around, on any shape, as far as shear is
// free.
TEST_F(PressureSurfaceTest, SubmergedSolidIsInEquilibriumAtAnyPressure) {
  for (double P : {1e-3, 1.0, 1e4}) {
    for (double c10 : {0.0, .5}) {
      Solid solid(X, mesh.hexes, {{"a", NeoHooke{c10}, 0, 18}});
      const std::vector<double>& at = c10 == 0 ? x : X;  // deformed without shear modulus; undeformed with it
      std::vector<double> f(X.size()), volume_error(18), lambda(18, -P);
      solid.residual(at, lambda, f, volume_error);
      const double size = largest(f);
      surface.add_gradient(at, -P, f);
      EXPECT_LT(largest(f), 1e-13 * (size + c10));
    }
  }
}

}  // namespace
}  // namespace bulbus
