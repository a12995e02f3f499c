#include <gtest/gtest.h>

#include <filesystem>
#include <numbers>

#include "contact/rigid/rigid_motion.hpp"
#include "core/base/error.hpp"
#include "core/io/checkpoint.hpp"
#include "core/mesh/distributed/partition.hpp"
#include "core/mesh/generate/generate.hpp"
#include "tests/support/solids.hpp"
#include "tests/unit/contact/bodies.hpp"

namespace bulbus {
namespace {

using std::numbers::pi;

std::shared_ptr<RigidSurface> shared(const RigidBodySpec& spec) {
  return std::make_shared<RigidSurface>(body(spec));
}

RigidBodySpec two_arcs() {
  BandShape band;
  band.arc = {.from = 0, .to = 60, .parts = 2, .facets = 3};
  return {.band = band};
}

MoveSpec closing(double way, const std::string& from = "here") {
  MoveSpec m;
  m.close = way;
  m.from = from;
  return m;
}

Vec3<double> place(const RigidSurface& b, int p) { return at(b.places, p); }
Vec3<double> drawn(const RigidSurface& b, int p) { return at(b.reference, p); }

void expect_near(const Vec3<double>& a, const Vec3<double>& b, double tolerance = 1e-12) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

TEST(Motion, PartsCloseEachItsOwnWay) {
  const auto b = shared(two_arcs());
  RigidMotion motion(b);
  motion.begin(closing(2), {}, "");
  for (double s : {0., .25, 1.}) {
    motion.set_progress(s);
    for (const auto& part : b->parts)
      for (int p = part.first_point; p < part.first_point + part.points; ++p)
        expect_near(place(*b, p), drawn(*b, p) + 2 * s * part.inwards);
  }
  EXPECT_GT(norm(b->parts[0].inwards - b->parts[1].inwards), .4);
}

TEST(Motion, ShorteningClosesByTheRadius) {
  const auto b = shared(two_arcs());
  RigidMotion motion(b);
  MoveSpec shorten;
  shorten.shorten = 2 * b->shortening;
  motion.begin(shorten, {}, "");
  motion.set_progress(.5);
  for (const auto& part : b->parts)
    expect_near(place(*b, part.first_point), drawn(*b, part.first_point) + part.inwards);
  motion.set_closing(.25);
  expect_near(place(*b, 0), drawn(*b, 0) + 1.25 * b->parts[0].inwards);
  motion.freeze();
  expect_near(place(*b, 0), drawn(*b, 0) + 2.25 * b->parts[0].inwards);
  shorten.close = 1;
  try {
    motion.begin(shorten, {}, "steps.0.move.0");
    ADD_FAILURE();
  } catch (const InputError& fault) {
    EXPECT_EQ(fault.key, "steps.0.move.0.shorten");
  }
}

// Step 1 turns all parts by 90° about an axis through (1, 2, 0); step 2 closes along the turned directions;
// step 3 is at rest.
TEST(Motion, StepsFollowOneAnother) {
  const auto b = shared(two_arcs());
  RigidMotion motion(b);
  MoveSpec turn;
  turn.rotate = RotationSpec{{0, 0, 3}, {1, 2, 0}, pi / 2};
  turn.translate = {0, 0, 5};
  motion.begin(turn, {}, "");
  const auto turned = [](const Vec3<double>& x) {
    return Vec3<double>{1 - (x[1] - 2), 2 + (x[0] - 1), x[2] + 5};
  };
  motion.set_progress(.3);
  motion.freeze();
  for (int p = 0; p < static_cast<int>(b->places.size() / 3); ++p)
    expect_near(place(*b, p), turned(drawn(*b, p)));
  motion.begin(closing(1), {}, "");
  motion.set_progress(.7);
  motion.set_progress(.5);  // the increment was cut
  for (const auto& part : b->parts)
    for (int p = part.first_point; p < part.first_point + part.points; ++p)
      expect_near(place(*b, p),
                  turned(drawn(*b, p)) + .5 * Vec3<double>{-part.inwards[1], part.inwards[0], 0});
  motion.freeze();
  const auto end = b->places;
  motion.set_progress(.2);
  EXPECT_EQ(b->places, end);
  const auto poses = motion.poses();
  const auto again = shared(two_arcs());
  RigidMotion(again).set_poses(poses);
  EXPECT_EQ(again->places, end);
}

// As of a version of the program that made fewer triangles of the same scene.
TEST(Motion, GoesOnWithTheSurfaceThatWasKeptOnly) {
  const auto folder = std::filesystem::temp_directory_path() / "bulbus_body_of_a_checkpoint";
  std::filesystem::create_directories(folder);
  const std::string path = folder / "checkpoint.h5";
  const Mesh block = generate(BlockShape{});
  const LocalMesh mesh = distribute(block, partition(block, 1), Comm(MPI_COMM_SELF));
  const auto ball = [](int n) { return shared({.sphere = SphereShape{{0, 0, 10}, 1, n}}); };
  const auto coarse = ball(4), again = ball(4), fine = ball(8);
  write_checkpoint(path, mesh, [&](Archive& archive) { RigidMotion(coarse).serialize(archive); });
  EXPECT_NO_THROW(RigidMotion(again).serialize(*open_checkpoint(path, mesh)));
  EXPECT_THROW(RigidMotion(fine).serialize(*open_checkpoint(path, mesh)), InputError);
  write_checkpoint(path, mesh, [](Archive& archive) {
    const Archive::Group older(archive, "rigid body b");
    double none = 0;
    archive.scalars("start", none);
  });
  EXPECT_THROW(RigidMotion(again).serialize(*open_checkpoint(path, mesh)), InputError);
}

TEST(Motion, RotationIsARotationHalfwayToo) {
  const auto b = shared(two_arcs());
  RigidMotion motion(b);
  MoveSpec turn;
  turn.rotate = RotationSpec{{0, 0, 1}, {0, 0, 0}, pi / 2};
  motion.begin(turn, {}, "");
  motion.set_progress(.5);
  const double h = std::sqrt(.5);
  for (int p = 0; p < static_cast<int>(b->places.size() / 3); ++p) {
    const Vec3<double> X = drawn(*b, p);
    expect_near(place(*b, p), {h * (X[0] - X[1]), h * (X[0] + X[1]), X[2]});
  }
}

TEST(Touch, PlaneComesToTheNearestNode) {
  const RigidSurface b = body({.plane = PlaneShape{{0, 0, 10}, {0, 0, -1}, 8}});
  const std::vector<double> points{1, 1, 2, -2, 3, 4.5,
                                   0, 5, 9, 0,  0, -3};  // the highest one is beside the sheet
  EXPECT_NEAR(way_to_touch(b, b.parts[0], {0, 0, -1}, points), 5.5, 1e-12);
  const std::vector<double> behind{0, 0, 12};
  EXPECT_NEAR(way_to_touch(b, b.parts[0], {0, 0, -1}, behind), -2, 1e-12);
  EXPECT_EQ(way_to_touch(b, b.parts[0], {0, 0, 1}, points), INFINITY);  // sheets have one side
  EXPECT_NEAR(way_to_touch(b, b.parts[0], {.6, 0, -.8}, std::vector<double>{6, 0, 2}), 10, 1e-12);
}

// In a cavity the wall behind looks the way that the ball moves.
TEST(Touch, IsWithWhatLooksAgainstTheWay) {
  const auto b = shared({.sphere = SphereShape{{0, 0, 0}, 1, 64}});
  RigidMotion motion(b);
  MoveSpec m;
  m.from = "touch", m.translate = {0, 0, 2};
  motion.begin(m, {{0, 0, 5, 0, 0, -5}, {0, 0, -1, 0, 0, 1}}, "");
  EXPECT_NEAR(motion.poses()[0].shift[2], 4, 1e-4);
  try {
    motion.begin(m, {{0, 0, 5, 0, 0, -5}, {0, 0, 1, 0, 0, 1}}, "steps.0.move.0");
    ADD_FAILURE();
  } catch (const InputError& fault) {
    EXPECT_EQ(fault.key, "steps.0.move.0.from");
    EXPECT_NE(std::string(fault.what()).find("from behind"), std::string::npos) << fault.what();
  }
}

// A rod along x sinks onto the nodes of a sphere: the way to a node at (x, y, z) is z_rod − √(R² − y²) − z
TEST(Touch, RodOnASphereOfNodes) {
  const Mesh mesh = generate(ShellShape{.inner = 4, .outer = 5, .n = 6, .layers = 1, .part = "whole"});
  std::vector<double> points = places(mesh);
  const double R = 2, z = 9, shift = .37;
  double way = INFINITY;
  for (std::size_t p = 0; p < points.size(); p += 3) {
    points[p + 1] += shift;
    if (std::abs(points[p + 1]) < R)
      way = std::min(way, z - std::sqrt(R * R - points[p + 1] * points[p + 1]) - points[p + 2]);
  }
  const RigidSurface rod = body({.cylinder = RodShape{{0, 0, z}, {1, 0, 0}, R, 20, 3000}});
  EXPECT_NEAR(way_to_touch(rod, rod.parts[0], {0, 0, -1}, points), way, 2e-6);
  EXPECT_GT(way, 1.5);
}

// Contact is with the curved surface, and so is the touch. The means of normals at a rod's corners, weighted
// by areas, lean towards the side with two triangles and leave up to a third of the chord height.
TEST(Touch, RodOfFewFacetsMeetsAsACircle) {
  constexpr double R = 2, z = 9;
  const RigidSurface rod = body({.cylinder = RodShape{{0, 0, z}, {1, 0, 0}, R, 20, 60}});
  const double chord_height = R * (1 - std::cos(pi / 60));
  for (double y = -.3; y < .3; y += .01) {
    const std::vector<double> point{0, y, 4};
    EXPECT_NEAR(way_to_touch(rod, rod.parts[0], {0, 0, -1}, point), z - std::sqrt(R * R - y * y) - 4,
                .4 * chord_height)
        << y;
  }
}

// Drawn at the radius of the eye at rest, closed onto the inflated one: every arc first has to give way.
TEST(Touch, EveryArcStandsWhereItFirstTouches) {
  const Mesh mesh = generate(ShellShape{.inner = 11, .outer = 12.3, .n = 8, .layers = 1, .part = "half"});
  const std::vector<double> points = places(mesh);
  BandShape band;
  band.arc = {.from = 0, .to = 180, .parts = 6, .facets = 12};
  const auto inside = [&](const RigidSurface& b) {
    int count = 0;
    for (std::size_t p = 0; p < points.size(); p += 3)
      if (std::abs(points[p + 2]) < 2) count += winding(b, {points[p], points[p + 1], points[p + 2]}) > .5;
    return count;
  };
  for (int part = 0; part < 6; ++part) {
    BandShape one = band;
    one.arc.from = 30. * part;
    one.arc.to = 30. * part + 30;
    one.arc.parts = 1;
    const auto b = shared({.band = one});
    RigidMotion motion(b);
    EXPECT_GT(inside(*b), 0);
    MoveSpec m = closing(0, "touch");
    m.close = 1;
    motion.begin(m, {points, {}}, "");
    EXPECT_EQ(inside(*b), 0);
    motion.set_progress(4e-3);  // the edges' chord height, 0.2 (1 − cos 11.25°), and the clearance of 1e-6 mm
    EXPECT_GT(inside(*b), 0);
    EXPECT_NEAR(norm(motion.poses()[0].shift), .3, .05);
  }
}

TEST(Touch, TheWayGoesAlongTranslateUnlessPartsClose) {
  const auto b = shared({.sphere = SphereShape{{0, 0, 10}, 1, 16}});
  RigidMotion motion(b);
  MoveSpec m;
  m.from = "touch";
  m.translate = {0, 0, -2};
  motion.begin(m, {{0, 0, 3}, {}}, "");
  expect_near(motion.poses()[0].shift, {0, 0, -6 + 1e-6}, 1e-12);
  motion.freeze();
  expect_near(motion.poses()[0].shift, {0, 0, -8 + 1e-6}, 1e-12);
}

TEST(Touch, WhatNeverMeetsIsRefused) {
  RigidMotion motion(shared({.sphere = SphereShape{{0, 0, 10}, 1, 4}}));
  const std::vector<double> aside{3, 0, 0};
  MoveSpec m;
  m.from = "touch";
  m.translate = {0, 0, -2};
  EXPECT_THROW(motion.begin(m, {aside, {}}, "steps.1.move.0"), InputError);
  m.translate = {0, 0, 0};
  EXPECT_THROW(motion.begin(m, {{0, 0, 0}, {}}, "steps.1.move.0"), InputError);  // no direction
  EXPECT_THROW(motion.begin(closing(1), {}, "steps.1.move.0"), InputError);
  try {
    motion.begin(closing(1), {}, "steps.1.move.0");
  } catch (const InputError& fault) {
    EXPECT_EQ(fault.key, "steps.1.move.0.close");
  }
}

}  // namespace
}  // namespace bulbus
