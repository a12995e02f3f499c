#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/problem/validate.hpp"
#include "tests/support/models.hpp"

namespace bulbus {
namespace {

std::string complaint(const Scene& s) {
  try {
    require_supported(s.mesh, s.model);
  } catch (const InputError& e) {
    EXPECT_EQ(e.key, "fix");
    return e.what();
  }
  return "";
}

void expect_complaint(const Scene& s, const std::string& fragment) {
  EXPECT_NE(complaint(s).find(fragment), std::string::npos) << complaint(s);
}

Scene block() {
  Scene s{generate(BlockShape{.nx = 2, .ny = 2, .nz = 2}), {}};
  s.model.regions["block"] = neo_hooke(1);
  s.model.steps = {step("only")};
  return s;
}

int nearest_node(const Mesh& mesh, int from, const Point& p) {
  int best = from;
  for (int n = from; n < static_cast<int>(mesh.points.size()); ++n)
    if (norm(minus(mesh.points[n], p)) < norm(minus(mesh.points[best], p))) best = n;
  return best;
}

/// A ball that hangs in a held shell by bars along the six half axes, turned out of the radial direction by
/// `twist`.
Scene hanging_ball(bool bars, double twist) {
  Scene s{generate(ShellShape{.inner = 2, .outer = 2.5, .n = 4, .layers = 1, .part = "whole"}), {}};
  const int first = static_cast<int>(s.mesh.points.size());
  Mesh ball = generate(BallShape{.n = 2, .layers = 2, .part = "whole"});
  ball.surfaces = {{"ball_outer", ball.surfaces.at("outer")}};
  append(s.mesh, ball);
  if (bars)
    for (int axis = 0; axis < 3; ++axis)
      for (double sign : {-1.0, 1.0})
        for (double turn : {-twist, twist}) {
          Point d{0, 0, 0};
          d[axis] = sign;
          Point e = d;
          e[(axis + 1) % 3] += turn;
          const double length = norm(e);
          for (double& c : e) c *= 2 / length;
          s.mesh.bars["ties"].push_back(
              {at_node(nearest_node(s.mesh, first, d)), at_node(nearest_node(s.mesh, 0, e))});
        }
  s.model.regions = {{"shell", neo_hooke(1)}, {"ball", neo_hooke(1)}};
  s.model.fix.push_back({"outer", {"x", "y", "z"}});
  s.model.steps = {step("only")};
  return s;
}

TEST(Support, FreeBlockIsNamed) {
  expect_complaint(block(), "nothing prevents a rigid motion of the model (block)");
}

TEST(Support, FixedFaceHolds) {
  Scene s = block();
  s.model.fix.push_back({"zmin", {"x", "y", "z"}});
  EXPECT_EQ(complaint(s), "");
}

TEST(Support, ThreeSymmetryPlanesHold) {
  Scene s = block();
  s.model.symmetry = {"x", "y", "z"};
  EXPECT_EQ(complaint(s), "");
}

TEST(Support, TheMotionLeftIsNamed) {
  Scene s = block();
  s.model.symmetry = {"x", "y"};
  expect_complaint(s, "shift along (0.00, 0.00, 1.00)");
  s = block();
  s.model.fix.push_back({"zmin", {"z"}});
  s.mesh.node_sets["corner"] = {0};
  s.model.fix.push_back({"corner", {"x", "y"}});
  EXPECT_NE(complaint(s), "");
}

TEST(Support, PrescribedDisplacementsOfTheFirstStepHold) {
  for (int kind = 0; kind < 4; ++kind) {
    Scene s = block();
    DisplaceSpec d = displace("zmin");
    if (kind == 0) d.translate = Point{0, 0, 1};
    if (kind == 1) d.affine = std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (kind == 2) d.rotate = DisplaceSpec::Rotation{};
    if (kind == 3) d.x = d.y = d.z = "0";
    s.model.steps[0].displace.push_back(d);
    EXPECT_EQ(complaint(s), "") << kind;
    s.model.steps = {step("first"), s.model.steps[0]};
    EXPECT_NE(complaint(s), "") << kind;
  }
}

TEST(Support, RadialHoldsLeaveShiftAlongTheAxisAndTurns) {
  Scene s = block();
  DisplaceSpec d = displace("zmin");
  d.radial = "0";
  d.center = {.3, .3, 0};
  s.model.steps[0].displace.push_back(d);
  EXPECT_NE(complaint(s), "");
  s.model.fix.push_back({"zmin", {"z"}});
  expect_complaint(s, "rotation about (0.00, 0.00, 1.00)");
}

TEST(Support, OneOfTwoSeparateBlocksIsFree) {
  Scene s = block();
  s.model.fix.push_back({"zmin", {"x", "y", "z"}});
  Mesh other = generate(BlockShape{.lower = {3, 0, 0}, .upper = {4, 1, 1}, .region = "loose"});
  other.surfaces.clear();
  append(s.mesh, other);
  s.model.regions["loose"] = neo_hooke(1);
  expect_complaint(s, "a part of the model (loose)");
}

// Two of four cells, which share an edge along z or, of eight, a corner.
TEST(Support, PartsThatShareNoFaceAreHinged) {
  for (const bool edge : {true, false}) {
    Scene s = block();
    const int last = edge ? 3 : 7;
    Mesh cells = generate(BlockShape{.nx = 2, .ny = 2, .nz = edge ? 1 : 2});
    cells.hexes = {cells.hexes[0], cells.hexes[last]};
    cells.region.resize(2);
    cells.surfaces.clear();
    cells.node_sets = {{"first", {cells.hexes[0].begin(), cells.hexes[0].end()}},
                       {"second", {cells.hexes[1].begin(), cells.hexes[1].end()}}};
    s.mesh = cells;
    s.model.fix.push_back({"first", {"x", "y", "z"}});
    expect_complaint(s, edge ? "rotation about (0.00, 0.00, 1.00)" : "rotation about");
    expect_complaint(s, "no face");
    s.model.fix.push_back({"second", {"x", "y"}});
    EXPECT_EQ(complaint(s), "");
  }
}

TEST(Support, BallWithoutBarsIsFree) {
  expect_complaint(hanging_ball(false, 0), "a part of the model (ball)");
}

TEST(Support, RadialBarsAloneLeaveTheBallFreeToTurn) {
  expect_complaint(hanging_ball(true, 0), "(ball), rotation about");
}

TEST(Support, InclinedBarsHoldTheBall) { EXPECT_EQ(complaint(hanging_ball(true, .6)), ""); }

TEST(Support, BarsDoNotHoldAWholeThatFloats) {
  Scene s = hanging_ball(true, .6);
  s.model.fix.clear();
  EXPECT_NE(complaint(s), "");
}

TEST(Support, IsNotReleasedInALaterStep) {
  Scene s = block();
  s.model.fix.push_back({"zmin", {"z"}});
  s.model.steps = {step("hold"), step("let go")};
  s.model.steps[0].displace = {{.set = "zmax", .x = "0", .y = "0", .z = "0.1"}};
  EXPECT_NO_THROW(require_supported(s.mesh, s.model));
  s.model.steps[1].release = {"zmax"};
  try {
    require_supported(s.mesh, s.model);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_EQ(e.key, "steps.1.release");
  }
  s.model.steps[1].displace = {{.set = "zmax", .x = "0", .y = "0"}};
  EXPECT_NO_THROW(require_supported(s.mesh, s.model));
}

}  // namespace
}  // namespace bulbus
