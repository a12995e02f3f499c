#include "core/problem/fibre_directions.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/support/solids.hpp"

namespace bulbus {
namespace {

constexpr double pi = 3.14159265358979323846;

FibreFamilySpec at_angle(double angle) {
  FibreFamilySpec f;
  f.angle = angle;
  return f;
}

FibreFamilySpec along(std::vector<std::string> formulas) {
  FibreFamilySpec f;
  f.direction = std::move(formulas);
  return f;
}

std::vector<double> directions(const Mesh& mesh, std::vector<FibreFamilySpec> families) {
  return fibre_directions({1, 1, 0, std::move(families)}, "fibres", places(mesh), mesh.hexes);
}

Vec3<double> middle(const Mesh& mesh, std::size_t hex) {
  Vec3<double> m{0, 0, 0};
  for (int n : mesh.hexes[hex])
    for (int c = 0; c < 3; ++c) m[c] += mesh.points[n][c] / 8;
  return m;
}

// In the sphere, the circle level and counter-clockwise, the meridian towards the axis.
TEST(FibreDirections, FollowCirclesAndMeridians) {
  const Mesh mesh = generate(ShellShape{.inner = 2, .outer = 3, .n = 3, .layers = 1, .part = "octant"});
  const auto d = directions(mesh, {at_angle(0), at_angle(pi / 2), at_angle(pi / 3)});
  ASSERT_EQ(d.size(), 9 * mesh.hexes.size());
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    const Vec3<double> r = middle(mesh, h), circle = at(d, static_cast<int>(3 * h)),
                       meridian = at(d, static_cast<int>(3 * h + 1)),
                       between = at(d, static_cast<int>(3 * h + 2));
    const double rho = std::hypot(r[0], r[1]);
    EXPECT_NEAR(circle[0], -r[1] / rho, 1e-14);
    EXPECT_NEAR(circle[1], r[0] / rho, 1e-14);
    EXPECT_EQ(circle[2], 0);
    EXPECT_NEAR(norm(meridian), 1, 1e-14);
    EXPECT_NEAR(dot(meridian, circle), 0, 1e-14);
    EXPECT_NEAR(dot(meridian, r), 0, 1e-13);
    EXPECT_GT(meridian[2], 0);
    EXPECT_NEAR(dot(between, circle), .5, 1e-14);
    EXPECT_NEAR(dot(between, meridian), std::sqrt(.75), 1e-14);
  }
}

TEST(FibreDirections, HaveAnAxisAndACentre) {
  const Mesh mesh = shaken_block(2, 2, 2);
  FibreFamilySpec f = at_angle(0);
  f.axis = {3, 0, 0}, f.center = {0, 10, 1};
  const auto d = directions(mesh, {f});
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    const Vec3<double> r = middle(mesh, h);
    const double y = r[1] - 10, z = r[2] - 1, rho = std::hypot(y, z);
    EXPECT_EQ(d[3 * h], 0);
    EXPECT_NEAR(d[3 * h + 1], -z / rho, 1e-14);
    EXPECT_NEAR(d[3 * h + 2], y / rho, 1e-14);
  }
}

TEST(FibreDirections, AreUnitVectorsOfFormulas) {
  const Mesh mesh = shaken_block(2, 1, 1);
  const auto d = directions(mesh, {along({"X", "2*Z", "-1"})});
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h) {
    const Vec3<double> r = middle(mesh, h), want{r[0], 2 * r[2], -1};
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(d[3 * h + c], want[c] / norm(want), 1e-14);
  }
}

TEST(FibreDirections, OfFormulasHaveNoAxis) {
  FibreFamilySpec f = along({"1", "0", "0"});
  f.axis = {0, 1, 0};
  EXPECT_THROW(directions(shaken_block(1, 1, 1), {f}), InputError);
}

TEST(FibreDirections, AreRefusedOnTheAxis) {
  const Mesh mesh = shaken_block(1, 1, 1, 0);
  FibreFamilySpec f = at_angle(0);
  f.center = {.5, .5, -3};
  EXPECT_THROW(directions(mesh, {f}), InputError);
  EXPECT_THROW(directions(mesh, {along({"0", "0", "X - .5"})}), InputError);
}

}  // namespace
}  // namespace bulbus
