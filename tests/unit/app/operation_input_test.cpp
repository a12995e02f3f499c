// What the command says of rigid bodies, contacts and sutures that cannot be.
#include <gtest/gtest.h>

#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;
namespace fs = std::filesystem;

/// A block under a plate, with a rod beside it that a string runs over. Line 8 is the plate.
const std::string scene = R"yaml(title: operation
mesh: {block: {upper: [2, 1, 1], nx: 2, ny: 2, nz: 2}}
regions:
  block: {c10: 0.5}
symmetry: [x, y]
fix: [{set: zmin, directions: [z]}]
rigid_bodies:
  plate: {plane: {point: [0, 0, 1.05], normal: [0, 0, -1]}}
  rod: {swept: {section: [[-.2, -.2], [.2, -.2], [.2, .2], [-.2, .2]], at: [.5, 2.5], zero: [1, 0, 0]}}
contacts:
  - {name: top, slave: zmax, master: plate}
sutures:
  knot: {body: rod, surface: xmax, points: [[2, .5, .5]]}
steps:
  - {name: rest}
solver:
  linear: {method: direct}
)yaml";

struct Slip {
  std::string from, to, message;
};

void expect_slip_refused(const Slip& slip) {
  for (const char* command : {"run", "check"}) {
    const Ran r = run_scene(replaced(scene, slip.from, slip.to), {}, command);
    EXPECT_EQ(r.status, 2) << slip.to;
    EXPECT_NE(r.err.find("scene.yaml:" + slip.message), std::string::npos) << r.err;
    EXPECT_FALSE(fs::exists(r.folder / "out"));
  }
}

TEST(OperationInput, IsAcceptedAsItStands) { EXPECT_EQ(run_scene(scene, {}, "check").status, 0); }

TEST(OperationInput, ContactsNeedTwoSurfacesWithNodesOfTheirOwn) {
  const std::string top = "slave: zmax, master: plate";
  for (const Slip& s : std::vector<Slip>{
           {top, "slave: zmax, master: zmax",
            "11: contacts.0.master: contact 'top' names surface 'zmax' twice\n  Give the two sides as two "
            "surfaces"},
           {top, "slave: zmax, master: outside",
            "11: contacts.0.slave: contact 'top' has no slave nodes: all nodes of 'zmax' are nodes of "
            "'outside' too\n  Give"},
           {top, "slave: zmx, master: plate",
            "11: contacts.0.slave: the mesh has no surface 'zmx'\n  Did you mean 'zmax'?"},
           {top, "slave: zmax, master: plat",
            "11: contacts.0.master: there is no surface or rigid body 'plat'\n  Did you mean 'plate'?"}})
    expect_slip_refused(s);
  const std::string rigid = replaced(
      replaced(scene, "symmetry: [x, y]\nfix: [{set: zmin, directions: [z]}]", "symmetry:\n  [x, y, z]"),
      "block: {c10: 0.5}", "block: {rigid: true}");
  EXPECT_NE(run_scene(rigid, {}, "check")
                .err.find("scene.yaml:11: contacts.0.penalty: contact 'top' is between rigid sides only"),
            std::string::npos);
  const std::string renamed = replaced(replaced(scene, "plate:", "xmin:"), "master: plate", "master: xmin");
  EXPECT_NE(
      run_scene(renamed, {}, "check").err.find("scene.yaml:11: contacts.0.master: 'xmin' is both a surface"),
      std::string::npos);
}

TEST(OperationInput, BodiesHaveTheirInsideInside) {
  expect_slip_refused(
      {"section: [[-.2, -.2], [.2, -.2], [.2, .2], [-.2, .2]]",
       "section: [[-.2, .2], [.2, .2], [.2, -.2], [-.2, -.2]]",
       "9: rigid_bodies.rod.swept.section: the section is inside out\n  List its corners in the "
       "opposite order"});
  const std::string file = fs::temp_directory_path() / "bulbus_inside_out.stl";
  std::ofstream stl(file);
  stl << "solid\n";
  for (const char* corners :
       {"vertex 0 0 3 vertex 1 0 3 vertex 0 1 3", "vertex 0 0 3 vertex 0 1 3 vertex 0 0 4",
        "vertex 0 0 3 vertex 0 0 4 vertex 1 0 3", "vertex 1 0 3 vertex 0 0 4 vertex 0 1 3"})
    stl << "facet normal 0 0 0 outer loop " << corners << " endloop endfacet\n";
  stl << "endsolid\n";
  stl.close();
  expect_slip_refused({"plane: {point: [0, 0, 1.05], normal: [0, 0, -1]}", "file: {path: " + file + "}",
                       "8: rigid_bodies.plate.file.path: " + file +
                           ": the body is inside out: its triangles turn their normals inwards\n  Turn all"});
  fs::remove(file);
}

TEST(OperationInput, SuturePointsLieOnTheirSurface) {
  const std::string points = "points: [[2, .5, .5]]";
  for (const Slip& s :
       std::vector<Slip>{{points, "points: [[4, .5, .5]]",
                          "13: sutures.knot.points.0: the point lies 2 mm off 'xmax'\n  The nearest point on "
                          "it is [2, 0.5, 0.5]."},
                         {points, "pair: {azimuth: 0, spacing: .5, axial: .5}, zero: [-1, 0, 0]",
                          "13: sutures.knot.pair: the meridian does not meet 'xmax'"},
                         {points, "pair: {azimuth: 0, spacing: 3, axial: .5}, zero: [1, 0, 0]",
                          "13: sutures.knot.pair.spacing: 'xmax' ends 1.000000 mm before a point"},
                         {points, "sets: [xmx]",
                          "13: sutures.knot.sets: the mesh has no node set, surface or region 'xmx'\n  did "
                          "you mean 'xmax'?"}})
    expect_slip_refused(s);
}

TEST(OperationInput, StringsPullTwoPoints) {
  expect_slip_refused({"points: [[2, .5, .5]]", "points: [[2, .5, .5], [2, .5, .5]]",
                       "13: sutures.knot: both of its points are at (2, 0.5, 0.5) mm"});
  expect_slip_refused({"{name: rest}", "{name: rest, sew: {knot: -0.1}}",
                       "15: steps.0.sew.knot: a string pulls, it cannot push with 0.1 N"});
}

// Nodes that just touch bear nothing, and nothing is said of their energy.
TEST(OperationInput, ContactsThatJustTouchAreNotToldOf) {
  const Ran r = run_scene(replaced(scene, "point: [0, 0, 1.05]", "point: [0, 0, 1]"));
  EXPECT_EQ(r.status, 0) << r.err;
  EXPECT_EQ(r.summary()["warnings"].dump(), "[]");
}

TEST(OperationInput, OverlapsAtTheStartAreRefused) {
  expect_slip_refused(
      {"point: [0, 0, 1.05]", "point: [0, 0, .95]",
       "11: contacts.0: contact 'top' starts with 9 of its points inside 'plate', the deepest by "
       "0.05 mm at (0, 0, 1)\n"
       "  Draw the two apart, or say `start: resolve`."});
}

}  // namespace
