// Contact against closed forms: blocks pressed together, Hertz, a ball that is pressed and let go.
#include "tests/verify/two_blocks.hpp"

namespace bulbus {
namespace {

constexpr double c10 = block_c10, mu = 2 * c10;

double pressed(ContactTrial& run) {
  run.direct();
  EXPECT_TRUE(run.report.converged) << run.report.reason;
  return run.force("joint")[2];
}

TEST(Blocks, PenaltyErsWithItsInverse) {
  double before = 0;
  for (double alpha : {10., 100., 1000., 10000.}) {
    ContactTrial run(two_blocks(3, 3, alpha));
    const double force = pressed(run), error = relative(force, uniaxial(.9));
    measured("two blocks, matching nodes, penalty {:g} MPa/mm: force off by {:.2e} (of the exact one with that penalty {:.1e})", alpha, error,
             relative(force, with_penalty(alpha)));
    EXPECT_LT(relative(force, with_penalty(alpha)), 1e-8);
    if (before > 0) {
      EXPECT_NEAR(before / error, 10, alpha < 1000 ? 3 : .5);
    }
    before = error;
  }
}

TEST(Blocks, AugmentedForceIsExact) {
  ContactTrial run(two_blocks(3, 3, 100, 1e-8));
  const double error = relative(pressed(run), uniaxial(.9));
  const auto& augmentation = run.contact("joint").augmentation();
  measured("two blocks, matching nodes, augmented to 1e-8 mm: force off by {:.1e} (target 1e-6) after {} updates in the last increment", error, augmentation.updates);
  EXPECT_LT(error, 1e-6);
  EXPECT_FALSE(augmentation.gave_up);
}

/// The largest relative distance from a uniaxial Cauchy stress in the upper block.
double scatter(const ContactTrial& run, double sigma) {
  double worst = 0;
  const auto stresses = run.problem.solid().stresses(run.state.x, run.state.lambda);
  const SolidRegion& high = *std::ranges::find(run.problem.solid().regions(), "high", &SolidRegion::name);
  for (int h = high.first; h < high.first + high.count; ++h) worst = std::max(worst, relative(stresses[h].mises, std::abs(sigma)));
  return worst;
}

/// Sums over the pairs of forces and of moments, both over the force.
std::pair<double, double> imbalance(const ContactTrial& run) {
  std::vector<double> f(run.state.x.size());
  run.contact("joint").add_residual(run.state, f, {});
  Vec3<double> sum{0, 0, 0}, moment{0, 0, 0};
  double size = 0;
  for (std::size_t n = 0; n < f.size(); n += 3) {
    const Vec3<double> at_node{f[n], f[n + 1], f[n + 2]}, m = cross({run.state.x[n], run.state.x[n + 1], run.state.x[n + 2]}, at_node);
    for (int c = 0; c < 3; ++c) sum[c] += at_node[c], moment[c] += m[c];
    size += norm(at_node);
  }
  return {norm(sum) / size, norm(moment) / size};
}

// A narrower block on one that is nearly rigid, with nodes that do not match: uniaxial by itself.
TEST(Blocks, NodesThatDoNotMatchPressTheSlaveEvenly) {
  for (const auto& [low, high] : {std::pair{4, 3}, {3, 4}}) {
    Scene scene = two_blocks(low, high, 100, 1e-8, 1.3);
    scene.model.regions["low"] = neo_hooke(1e4 * c10);
    ContactTrial run(scene);
    const double error = relative(pressed(run), uniaxial(.8)), uneven = scatter(run, uniaxial(.8) * .8);
    const auto [force, moment] = imbalance(run);
    measured("two blocks, {0} x {0} faces on {1} x {1} of a wider, stiff one: force off by {2:.1e}, Mises stress by at most {3:.1e}; sum of the pairs' forces {4:.0e}, of their moments {5:.0e}, over the force",
             high, low, error, uneven, force, moment);
    EXPECT_LT(error, 1e-3);
    EXPECT_LT(uneven, 1e-3);
    EXPECT_LT(force, 1e-14);
    EXPECT_LT(moment, 1e-14);
  }
}

/// A quarter of a half-space z > 0, up to 10 mm, with cells of 0.17 / n mm at the origin; a rigid ball of radius 1 mm comes from below.
Scene hertz(int n) {
  Scene scene{generate(BallShape{.radius = 1, .n = n, .layers = n}), {}};
  for (Point& p : scene.mesh.points)
    if (const double r = norm(p); r > 0)
      for (double& c : p) c *= 10 * std::sinh(6 * r) / std::sinh(6) / r;
  Model& m = scene.model;
  m.regions["ball"] = neo_hooke(c10);
  m.symmetry = {"x", "y"};
  m.fix.push_back({"outer", {"x", "y", "z"}});
  m.rigid_bodies["ball"].sphere = SphereShape{.center = {0, 0, -1.5}, .radius = 1, .facets = 100};
  m.contacts = {contact("pole", "zmin", "ball")};
  m.contacts[0].penalty = 2e3, m.contacts[0].depth = .02, m.contacts[0].tolerance = 1e-6;
  for (double way : {.0025, .0025, .005}) {
    StepSpec s = step("press");
    s.move = {shift("ball", {0, 0, way}, m.steps.empty() ? "touch" : "here")};
    m.steps.push_back(s);
  }
  return scene;
}

// F = 16/3 μ √R δ^(3/2) for an incompressible half-space, contact area π R δ.
TEST(Hertz, ForceOfARigidBallOnAHalfSpace) {
  for (int n : {6, 9}) {
    ContactTrial run(hertz(n));
    int steps = 0;
    run.watch = [&](const Increment& i, const State& state) {
      if (i.progress < 1) return;
      const double delta = std::array{.0025, .005, .01}[steps++], exact = 16. / 3 * mu * std::pow(delta, 1.5);
      const ContactFigures f = run.contact("pole").figures(state);
      const double error = -4 * f.on_master[0].force[2] / exact - 1;
      measured("Hertz, {} hexahedra, depth / radius {:g}: force off by {:+.2f} %{}, contact area by {:+.0f} %; largest penetration {:.0e} of the depth",
               run.problem.mesh().all_hexes, delta, 100 * error, n == 9 ? " (target 5 %)" : "", 100 * (4 * f.area / (M_PI * delta) - 1), f.penetration / delta);
      EXPECT_LT(std::abs(error), n == 9 ? .05 : .15) << delta;
    };
    run.direct();
    EXPECT_TRUE(run.report.converged) << run.report.reason;
    EXPECT_EQ(steps, 3);
  }
}

TEST(Ball, ReturnsToItsShapeWhenLetGo) {
  Scene scene{generate(BallShape{.radius = 1, .n = 4, .layers = 4}), {}};
  Model& m = scene.model;
  m.regions["ball"] = neo_hooke(c10);
  m.symmetry = {"x", "y", "z"};
  m.rigid_bodies["plate"].plane = PlaneShape{.point = {0, 0, 1.5}, .normal = {0, 0, -1}};
  m.contacts = {contact("pole", "outer", "plate")};
  StepSpec press = step("press", 4), release = step("release", 2);
  press.move = {shift("plate", {0, 0, -.3}, "touch")};
  release.move = {shift("plate", {0, 0, .7})};
  m.steps = {press, release};
  ContactTrial run(scene);
  run.settings.newton = {};  // where contact ends there is no force to be relative to
  double most = 0, force = 0;
  const auto moved = [&](const State& s) { return largest(plus(s.x, -1, run.problem.mesh().X)); };
  run.watch = [&](const Increment&, const State& s) {
    if (moved(s) < most) return;
    most = moved(s);
    force = 4 * run.contact("pole").figures(s).on_master[0].force[2];
  };
  run.direct();
  ASSERT_TRUE(run.report.converged) << run.report.reason;
  measured("ball pressed to 0.7 of its height (largest displacement {:.3f} of the radius, force {:.3f} mu R²) and let go: {:.0e} of the radius is left", most, force / mu,
           moved(run.state));
  EXPECT_GT(force, .5);
  EXPECT_LT(moved(run.state), 1e-8);
  EXPECT_EQ(run.pairs("pole"), 0);
}

}  // namespace
}  // namespace bulbus
