#include "contact/interaction_probes.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "tests/support/models.hpp"

namespace bulbus {
namespace {

constexpr double ring_penalty = 20;

ProbeSpec probe(const std::string& kind, const std::string& component = "magnitude") {
  ProbeSpec p;
  p.name = kind + " " + component;
  p.kind = kind, p.component = component, p.contact = "press", p.body = "plate", p.suture = "string";
  return p;
}

ProbeSpec gap(const std::string& statistic, const std::string& set = "") {
  ProbeSpec p = probe("gap");
  p.statistic = statistic, p.set = set;
  return p;
}

ProbeSpec sealed(const std::string& set) {
  ProbeSpec p = probe("sealed_fraction");
  p.set = set;
  return p;
}

/// A block between x = 0 and 2, y = ±1, z = ±1 (or its quarter y, z > 0) whose face x = 2 looks at a plate.
Scene block(double plate, bool quarter = false) {
  const double low = quarter ? 0 : -1;
  const int n = quarter ? 1 : 2;
  Scene s{generate(BlockShape{.lower = {0, low, low}, .upper = {2, 1, 1}, .nx = 2, .ny = n, .nz = n}), {}};
  s.model.regions["block"] = neo_hooke(.5);
  s.model.fix.push_back({"xmin", {"x", "y", "z"}});
  if (quarter) s.model.symmetry = {"y", "z"};
  s.model.rigid_bodies["plate"].plane = PlaneShape{.point = {plate, 0, 0}, .normal = {-1, 0, 0}};
  s.model.contacts.push_back({.name = "press", .slave = "xmax", .master = "plate"});
  s.model.contacts[0].penalty = ring_penalty;
  s.model.contacts[0].start = "resolve";
  s.model.steps = {step("one")};
  return s;
}

using Map = std::function<Vec3<double>(const Vec3<double>&)>;

std::vector<double> figures(Scene scene, const std::vector<ProbeSpec>& probes, const Map& map = {}) {
  scene.model.probes = probes;
  Problem problem(scene.mesh, scene.model, Comm());
  const auto interactions = Interactions::attach(problem, scene.mesh);
  State state = problem.initial_state();
  for (int n = 0; map && n < problem.mesh().nodes(); ++n) {
    const Vec3<double> x = map(at(state.x, n));
    std::copy(x.begin(), x.end(), state.x.begin() + 3 * n);
  }
  return ProbeSet(problem, interaction_probes(interactions)).values(problem, state);
}

/// Pressed in by .01 everywhere: the pressure is .2 MPa on 4 mm². Of the slave nodes' areas a half lies at y
/// = 0.
TEST(OperationProbes, MeasureAPlateThatPresses) {
  std::vector<ProbeSpec> probes;
  for (const char* kind :
       {"contact_area", "contact_pressure", "penetration", "contact_fraction", "mean_contact_pressure"})
    probes.push_back(probe(kind));
  probes.push_back(gap("mean"));
  for (const char* kind : {"contact_force", "body_force"})
    for (const char* c : {"x", "y", "magnitude", "radial"}) probes.push_back(probe(kind, c));
  const double F = ring_penalty * .01 * 4, radial = F * (.5 + .5 * 2 / std::sqrt(5));
  const double expected[] = {4, .2, .01, 1, .2, -.01, F, 0, F, radial, F, 0, F, radial};
  for (bool quarter : {false, true}) {
    const auto v = figures(block(1.99, quarter), probes);
    for (std::size_t i = 0; i < v.size(); ++i)
      EXPECT_NEAR(v[i], expected[i], 1e-12) << quarter << ' ' << probes[i].name;
  }
}

/// Only the half y > 0 is pressed, harder outwards: 0 at y = 0, .02 at y = 1, where a quarter of the area is.
TEST(OperationProbes, MeasureAMoment) {
  const Map tilt = [](const Vec3<double>& X) { return Vec3<double>{X[0] + .01 * X[1] * X[0], X[1], X[2]}; };
  const double F = ring_penalty * .02 * 1;
  const auto v = figures(
      block(2),
      {probe("body_force", "x"), probe("body_moment", "z"), probe("penetration"), probe("contact_area"),
       probe("contact_fraction"), probe("mean_contact_pressure"), sealed("ymax"), sealed("zmax")},
      tilt);
  EXPECT_NEAR(v[0], F, 1e-12);
  EXPECT_NEAR(v[1], -F, 1e-12);  // −y F_x
  EXPECT_NEAR(v[2], .02, 1e-12);
  EXPECT_NEAR(v[3], 2, 1e-3) << "of the tilted face, as far as y = 0";
  EXPECT_NEAR(v[4], .5, 1e-6);
  EXPECT_NEAR(v[5], F / v[3], 1e-12);
  EXPECT_EQ(v[6], 1);
  EXPECT_NEAR(v[7], .25, 1e-4) << "a half length at y = 1: the node at y = 0 touches without pressure";
}

/// An edge in a plane of symmetry is none of the whole.
TEST(OperationProbes, RefuseASetWithoutAnEdge) {
  for (const char* set : {"ymin", "xmin"}) {
    try {
      figures(block(1.99, true), {sealed(set)});
      ADD_FAILURE() << set;
    } catch (const InputError& fault) {
      EXPECT_EQ(fault.key, "probes.0.set");
      EXPECT_NE(std::string(fault.what()).find("no edge of the slave"), std::string::npos) << fault.what();
    }
  }
}

/// Also where it begins in the origin.
TEST(OperationProbes, RefuseAnEdgeInAPlaneOfSymmetryFromTheOrigin) {
  Scene s = block(1.99, true);
  s.model.fix[0].set = "xmax";
  s.model.contacts[0].slave = "xmin";
  s.model.rigid_bodies["plate"].plane = PlaneShape{.point = {.01, 0, 0}, .normal = {1, 0, 0}};
  EXPECT_THROW(figures(s, {sealed("ymin")}), InputError);
  EXPECT_EQ(figures(s, {sealed("ymax")}).size(), 1u);
}

/// A sheet without a size reaches the model from wherever its point is.
TEST(OperationProbes, PlaneReachesPastTheModelFromAnyPoint) {
  const auto push = [](double along) {
    Scene s = block(1.9);
    s.model.rigid_bodies["plate"].plane->point = {1.9, along, -2 * along};
    return figures(s, {probe("penetration")}).front();
  };
  EXPECT_NEAR(push(0), .1, 1e-12);
  EXPECT_NEAR(push(100), .1, 1e-12);
}

/// Columns of nodes at y = −1, 0, 1 are .1, .2, .3 before the plate.
TEST(OperationProbes, MeasureGaps) {
  const Map tilt = [](const Vec3<double>& X) {
    return Vec3<double>{X[0] - (X[0] == 2 ? .1 * X[1] : 0), X[1], X[2]};
  };
  ProbeSpec closed = probe("closed_fraction"), edge = closed;
  closed.tolerance = edge.tolerance = .25;
  edge.set = "ymax";
  const auto v =
      figures(block(2.2), {gap("min"), gap("mean"), gap("max"), gap("mean", "ymax"), closed, edge}, tilt);
  const double expected[] = {.1, .2, .3, .3, 2. / 3, 0};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(v[i], expected[i], 1e-12) << i;
}

/// A quarter of the diagonal √12 is as far as they see, much farther than the contact itself.
TEST(OperationProbes, GapsAreRightFarAway) {
  EXPECT_NEAR(figures(block(2.85), {gap("max")})[0], .85, 1e-12);
  EXPECT_NEAR(figures(block(9), {gap("max")})[0], 7, 1e-12);  // the fields end at a quarter of the diagonal
}

TEST(OperationProbes, MeasureSutures) {
  Scene scene = block(5);
  scene.mesh.node_sets["corner"] =
      nodes_where(scene.mesh, [](const Point& p) { return p[0] == 2 && p[1] == 1 && p[2] == 1; });
  scene.model.rigid_bodies["rod"].cylinder =
      RodShape{.center = {3, 0, 0}, .axis = {0, 0, 1}, .radius = .4, .length = 10};
  scene.model.sutures["string"] = {.body = "rod", .sets = {"corner"}, .generator = {0, 0, 1}};
  scene.model.steps[0].sew["string"] = .2;
  ProbeSpec least = probe("suture_mises"), near = least, everywhere = least;
  least.percentile = 0, near.within = 1, everywhere.within = 10;
  scene.model.probes = {probe("suture_force"), probe("suture_mises"), least, near, everywhere};
  Problem problem(scene.mesh, scene.model, Comm());
  const auto interactions = Interactions::attach(problem, scene.mesh);
  State state = problem.initial_state();
  problem.begin_step(0, state);
  problem.set_progress(.5, state);
  for (std::size_t n = 0; n < state.x.size(); n += 3)
    state.x[n] += .05 * state.x[n] * state.x[n] * (3 + state.x[n + 1]);
  const auto v = ProbeSet(problem, interaction_probes(interactions)).values(problem, state);
  double most = 0, sum = 0;
  for (const CellStress& c : problem.solid().stresses(state.x, state.lambda))
    most = std::max(most, c.mises), sum += c.mises;
  EXPECT_NEAR(v[0], .1, 1e-14);
  EXPECT_NEAR(v[1], most, 1e-12);  // the cell at the corner, and no other
  EXPECT_EQ(v[1], v[2]);
  EXPECT_NEAR(v[3], most, 1e-12);  // an octant of the ball lies in that cell
  EXPECT_NEAR(v[4], sum / 8, 1e-12);
}

struct Fault {
  ProbeSpec probe;
  std::string key, message;
};

TEST(OperationProbes, RefuseNamesThatAreNotThere) {
  ProbeSpec contact = probe("gap"), body = probe("body_force"), suture = probe("suture_force"),
            set = gap("mean", "xmin"), idle = probe("body_force");
  contact.contact = "pres", body.body = "plat", suture.suture = "strin", idle.body = "rod";
  Scene scene = block(3);
  scene.model.rigid_bodies["rod"].cylinder = RodShape{};
  for (const Fault& f : std::vector<Fault>{{contact, "contact", "Did you mean 'press'?"},
                                           {body, "body", "Did you mean 'plate'?"},
                                           {suture, "suture", "there is no suture 'strin'"},
                                           {idle, "body", "no contact has the rigid body 'rod'"},
                                           {set, "set", "no node of 'xmin'"}}) {
    try {
      figures(scene, {f.probe});
      ADD_FAILURE() << f.message;
    } catch (const InputError& fault) {
      EXPECT_EQ(fault.key, "probes.0." + f.key);
      EXPECT_NE(std::string(fault.what()).find(f.message), std::string::npos) << fault.what();
    }
  }
}

}  // namespace
}  // namespace bulbus
