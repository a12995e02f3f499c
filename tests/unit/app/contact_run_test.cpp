#include <gtest/gtest.h>

#include <cmath>

#include "core/io/hdf5_read.hpp"
#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;

/// A quarter of a block 4 × 2 × 1, pressed from above by a plate with α = 50 MPa/mm; then the plate leaves.
/// Line 20 is the first probe of a contact.
const std::string scene = R"yaml(title: press
mesh: {block: {upper: [2, 1, 1], nx: 2, ny: 2, nz: 2}}
regions:
  block: {c10: 0.5}
symmetry: [x, y]
fix: [{set: zmin, directions: [z]}]
rigid_bodies:
  plate: {plane: {point: [0, 0, 1.05], normal: [0, 0, -1]}}
contacts:
  - {name: top, slave: zmax, master: plate, penalty: 50}
steps:
  - name: press
    increments: 2
    move: [{body: plate, translate: [0, 0, -.25]}]
  - name: leave
    move: [{body: plate, translate: [0, 0, .5]}]
probes:
  - {name: support, kind: reaction, set: zmin, component: z}
  - {name: sink, kind: displacement, set: zmax, component: z, since: press}
  - {name: force, kind: contact_force, contact: top, component: z}
  - {name: on_plate, kind: body_force, body: plate, component: z, unit: mN}
  - {name: area, kind: contact_area, contact: top}
  - {name: pressure, kind: contact_pressure, contact: top, unit: kPa}
  - {name: depth, kind: penetration, contact: top}
  - {name: gap, kind: gap, contact: top, statistic: max}
  - {name: closed, kind: closed_fraction, contact: top, tolerance: .01}
  - {name: percent, kind: closed_fraction, contact: top, tolerance: .01, scale: 100}
  - {name: change, kind: closed_fraction, contact: top, tolerance: .01, since: press}
solver:
  linear: {method: direct}
  newton: {force: 1e-11, volume: 1e-11}
)yaml";

// Until the plate leaves.
Ran pressed(const std::vector<std::string>& set = {}) {
  const auto from = scene.find("  - name: leave"), to = scene.find("probes:");
  return run_scene(std::string(scene).erase(from, to - from), set);
}

/// Uniaxial: nominal pressure P = 1/l² − l at the stretch l, and P = α d at the penetration d = l − 0.8.
struct Pressed {
  double l = .81;
  Pressed() {
    for (int i = 0; i < 20; ++i) l -= (50 * (l - .8) - (1 / (l * l) - l)) / (50 + 2 / (l * l * l) + 1);
  }
  double P() const { return 1 / (l * l) - l; }
};

TEST(ContactRun, MeasuresAPlateThatPressesABlock) {
  const Ran r = pressed();
  ASSERT_EQ(r.status, 0) << r.err;
  const auto p = r.summary()["probes"];
  const Pressed exact;
  const double F = 8 * exact.P();
  EXPECT_NEAR(p["force"], F, 1e-8);
  EXPECT_NEAR(p["support"], F, 1e-8);
  EXPECT_NEAR(p["on_plate"], 1e3 * F, 1e-5);
  EXPECT_NEAR(p["area"], 8 / exact.l, 1e-8);
  EXPECT_NEAR(p["depth"], F / (50 * 8), 1e-10);
  EXPECT_NEAR(p["pressure"], 1e3 * F / (8 / exact.l), 1e-5);
  EXPECT_NEAR(p["gap"], -F / (50 * 8), 1e-10);
  EXPECT_EQ(p["closed"], 1);
}

// Drawn where the press above ends, the plate gets there by itself.
TEST(ContactRun, ResolvesAnOverlapGradually) {
  Ran r = pressed(
      {"rigid_bodies.plate.plane.point=[0, 0, .8]", "contacts.top.start=resolve", "steps.press.move=[]"});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(r.summary()["probes"]["force"], 8 * Pressed().P(), 1e-8);
  EXPECT_EQ(r.summary()["totals"]["increments"], 2);
}

TEST(ContactRun, SaysHowContactsAndBodiesStand) {
  const Ran r = pressed();
  ASSERT_EQ(r.status, 0) << r.err;
  const auto s = r.summary();
  const double l = Pressed().l, F = 8 * Pressed().P();
  EXPECT_EQ(s["contacts"]["top"]["penalty"], 50);
  EXPECT_EQ(s["contacts"]["top"]["active_nodes"], 9);
  EXPECT_NEAR(s["contacts"]["top"]["largest_penetration"], F / 400, 1e-10);
  const auto plate = s["rigid_bodies"]["plate"];
  EXPECT_NEAR(plate["force"][2], F, 1e-8);
  EXPECT_NEAR(plate["moment"][0], 0, 1e-8);
  ASSERT_EQ(plate["parts"].size(), 1u);
  EXPECT_NEAR(plate["parts"][0]["force"][2], F / 4, 1e-8);
  EXPECT_NEAR(plate["parts"][0]["moment"][0], F / 4 / (2 * std::sqrt(l)), 1e-8);  // y F
  const std::string log = r.text("run.log");
  EXPECT_NE(log.find("contact top: 9 nodes touch, largest penetration 0.0"), std::string::npos);
  EXPECT_NE(log.find("closed: 1.00 of its nodes are closer than 0.01 mm"), std::string::npos);
  EXPECT_NE(log.find("percent: 1.00 of its nodes are closer than 0.01 mm"), std::string::npos);
  EXPECT_EQ(s["probes"]["percent"], 100);
  EXPECT_EQ(log.find("change: 0.00 of its nodes"), std::string::npos);
}

TEST(ContactRun, CountsFromTheEndOfAStep) {
  const Ran r = run_scene(scene);
  ASSERT_EQ(r.status, 0) << r.err;
  const auto lines = r.lines("history.csv");
  ASSERT_EQ(lines.size(), 4u);
  EXPECT_NE(lines[1].find(",,"), std::string::npos);  // `sink` knows nothing yet
  EXPECT_NE(lines[2].find(",0,"), std::string::npos);
  const auto p = r.summary()["probes"];
  EXPECT_NEAR(p["sink"], 1 - Pressed().l, 1e-8);
  EXPECT_NEAR(p["gap"], .3, 1e-8);
  EXPECT_EQ(p["closed"], 0);
  EXPECT_EQ(p["area"], 0);
}

TEST(ContactRun, HasNoFigureBeforeItsStep) {
  const Ran r = run_scene(replaced(scene, "since: press", "since: leave"),
                          {"solver.stepping.minimum=0.9", "solver.newton.max_iterations=1"});
  EXPECT_EQ(r.status, 1) << r.err;
  EXPECT_TRUE(r.summary()["probes"]["sink"].is_null());
}

TEST(ContactRun, SavesContactAtTheNodes) {
  const Ran r = pressed();
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string file = r.folder / "out" / "result_0002.hdf";
  const auto field = [&](const std::string& name) { return read_dataset(file, "VTKHDF/" + name); };
  const auto X = field("Points"), gap = field("PointData/gap"),
             pressure = field("PointData/contact_pressure"), status = field("PointData/contact_status");
  const Pressed exact;
  ASSERT_EQ(gap.size(), X.size() / 3);
  for (std::size_t n = 0; n < gap.size(); ++n) {
    const bool top = X[3 * n + 2] > .99;
    if (!top) {
      EXPECT_TRUE(std::isnan(gap[n]) && std::isnan(pressure[n]) && std::isnan(status[n])) << n;
      continue;
    }
    EXPECT_EQ(status[n], 1) << n;
    EXPECT_NEAR(gap[n], .8 - exact.l, 1e-6) << n;
    EXPECT_NEAR(pressure[n], exact.P() * exact.l, 1e-6) << n;
  }
  EXPECT_NE(r.text("bodies_0002.vtp").find("Name=\"part\""), std::string::npos);
  EXPECT_NE(r.text("bodies.pvd").find("timestep=\"0.5\" part=\"0\" file=\"bodies_0001.vtp\""),
            std::string::npos);
}

TEST(ContactRun, SavesWhatIsWanted) {
  const Ran r = pressed({"output.fields=[displacement, gap]"});
  ASSERT_EQ(r.status, 0) << r.err;
  const std::string file = r.folder / "out" / "result_0002.hdf";
  EXPECT_NO_THROW(read_dataset(file, "VTKHDF/PointData/gap"));
  EXPECT_THROW(read_dataset(file, "VTKHDF/PointData/contact_status"), std::exception);
  EXPECT_FALSE(pressed({"output.vtk=false"}).wrote("bodies.pvd"));
}

TEST(ContactRun, FindsNamesThatAreNotThere) {
  for (const auto& [from, to, message] :
       {std::array{"force, contact: top", "force, contact: tap",
                   "scene.yaml:20: probes.2.contact: there is no contact 'tap'\n  Did you mean 'top'?"},
        std::array{"body: plate, component", "body: plat, component",
                   "scene.yaml:21: probes.3.body: there is no rigid body 'plat'\n  Did you mean 'plate'?"},
        std::array{"since: press", "since: pres",
                   "scene.yaml:19: probes.1.since: there is no step 'pres'\n  Did you mean 'press'?"}}) {
    const Ran r = run_scene(replaced(scene, from, to), {}, "check");
    EXPECT_EQ(r.status, 2);
    EXPECT_NE(r.err.find(message), std::string::npos) << r.err;
  }
}

}  // namespace
