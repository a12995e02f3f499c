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
    measured(
        "two blocks, matching nodes, penalty {:g} MPa/mm: force off by {:.2e} (of the exact one with that "
        "penalty {:.1e})",
        alpha, error, relative(force, with_penalty(alpha)));
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
  measured(
      "two blocks, matching nodes, augmented to 1e-8 mm: force off by {:.1e} (target 1e-6) after {} updates "
      "in the last increment",
      error, augmentation.updates);
  EXPECT_LT(error, 1e-6);
  EXPECT_FALSE(augmentation.gave_up);
}

/// The largest relative distance from a uniaxial Cauchy stress in the upper block.
double scatter(const ContactTrial& run, double sigma) {
  double worst = 0;
  const auto stresses = run.problem.solid().stresses(run.state.x, run.state.lambda);
  const SolidRegion& high = *std::ranges::find(run.problem.solid().regions(), "high", &SolidRegion::name);
  for (int h = high.first; h < high.first + high.count; ++h)
    worst = worse(worst, relative(stresses[h].mises, std::abs(sigma)));
  return worst;
}

/// Sums over the pairs of forces and of moments, both over the force.
std::pair<double, double> imbalance(const ContactTrial& run) {
  std::vector<double> f(run.state.x.size());
  run.contact("joint").add_residual(run.state, f, {});
  Vec3<double> sum{0, 0, 0}, moment{0, 0, 0};
  double size = 0;
  for (std::size_t n = 0; n < f.size(); n += 3) {
    const Vec3<double> at_node{f[n], f[n + 1], f[n + 2]},
        m = cross({run.state.x[n], run.state.x[n + 1], run.state.x[n + 2]}, at_node);
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
    measured(
        "two blocks, {0} x {0} faces on {1} x {1} of a wider, stiff one: force off by {2:.1e}, Mises stress "
        "by at most {3:.1e}; sum of the pairs' forces {4:.0e}, of their moments {5:.0e}, over the force",
        high, low, error, uneven, force, moment);
    EXPECT_LT(error, 1e-3);
    EXPECT_LT(uneven, 1e-3);
    EXPECT_LT(force, 1e-14);
    EXPECT_LT(moment, 1e-14);
  }
}

/// A sheet held at its ends in x, and a strip across it that goes down by .5 mm at its ends in y.
Scene sheets(double thickness, int increments) {
  const Mesh low = generate(BlockShape{
      .lower = {-1, -1, 0}, .upper = {1, 1, thickness}, .nx = 6, .ny = 6, .nz = 1, .region = "low"});
  Mesh high = generate(BlockShape{.lower = {-.4, -1.5, thickness + .05},
                                  .upper = {.4, 1.5, 2 * thickness + .05},
                                  .nx = 3,
                                  .ny = 7,
                                  .nz = 1,
                                  .region = "high"});
  Scene scene{low, {}};
  std::map<std::string, std::vector<Quad>> surfaces;
  for (const auto& [side, faces] : high.surfaces) surfaces["high " + side] = faces;
  high.surfaces = surfaces;
  append(scene.mesh, high);
  Model& m = scene.model;
  m.regions = {{"low", neo_hooke(c10)}, {"high", neo_hooke(c10)}};
  m.fix = {{"xmin", {"x", "y", "z"}}, {"xmax", {"x", "y", "z"}}};
  m.contacts = {contact_between("joint", "zmax", "high zmin")};
  StepSpec push = step("push", increments);
  for (const char* end : {"high ymin", "high ymax"}) {
    DisplaceSpec d = displace(end);
    d.x = d.y = "0", d.z = "-.5";
    push.displace.push_back(d);
  }
  m.steps = {push};
  return scene;
}

TEST(ThinSheet, IsCarriedAlongByASecondSheet) {
  for (double thickness : {.02, .1, .5}) {
    std::vector<double> force;
    for (int increments : {10, 1, 2, 3}) {
      ContactTrial run(sheets(thickness, increments));
      run.settings.newton = {};
      run.iterative();
      ASSERT_TRUE(run.report.converged) << run.report.reason << " " << thickness << " " << increments;
      force.push_back(run.force("joint")[2]);
      EXPECT_NEAR(force.back() / force[0], 1, 1e-3) << thickness << " " << increments;
    }
    measured(
        "a sheet of {:g} mm carried along by a second one in 10, 1, 2, 3 increments: {:.6g}, {:.6g}, {:.6g}, "
        "{:.6g} N",
        thickness, force[0], force[1], force[2], force[3]);
    EXPECT_GT(force[0], 0);
  }
}

/// A quarter of a half-space z > 0, up to .5 mm, with cells of .06 / n mm at the origin; 4 n³ hexahedra.
Mesh half_space(int n) {
  Mesh mesh = generate(BallShape{.radius = 1, .n = n, .layers = n});
  for (Point& p : mesh.points)
    if (const double r = norm(p); r > 0)
      for (double& c : p) c *= .5 * std::sinh(3.5 * r) / std::sinh(3.5) / r;
  return mesh;
}

const std::array<double, 3> depths{1.5e-4, 3e-4,
                                   6e-4};  // small, for the closed form is of small strains: a/R ≤ .025

void press(Scene& scene, const std::function<void(StepSpec&, double)>& by) {
  scene.model.contacts[0].penalty = 2e4, scene.model.contacts[0].depth = .01,
  scene.model.contacts[0].tolerance = 1e-6;
  for (double depth : depths) {
    scene.model.steps.push_back(step("press"));
    by(scene.model.steps.back(), depth);
  }
}

/// F = 4/3 E* √R δ^(3/2)
double hertz_force(double modulus, double radius, double depth) {
  return 4. / 3 * modulus * std::sqrt(radius) * std::pow(depth, 1.5);
}

/// The displacement of an incompressible half-space far from a load F along z (Boussinesq), over F/(4πμ),
/// less a shift along z.
DisplaceSpec far_away(const std::string& set, double force, double shift) {
  const std::string scale = fmt::format("{:.17g}", force / (4 * M_PI * mu)), r = "sqrt(X^2+Y^2+Z^2)";
  DisplaceSpec d = displace(set);
  d.x = scale + "*X*Z/" + r + "^3", d.y = scale + "*Y*Z/" + r + "^3",
  d.z = scale + "*(Z^2/" + r + "^3+1/" + r + ")" + fmt::format("-{:.17g}", shift);
  return d;
}

/// A rigid ball of radius 1 mm that comes from below.
Scene hertz(int n) {
  Scene scene{half_space(n), {}};
  Model& m = scene.model;
  m.regions["ball"] = neo_hooke(c10);
  m.symmetry = {"x", "y"};
  m.rigid_bodies["ball"].sphere = SphereShape{.center = {0, 0, -1.5}, .radius = 1, .facets = 200};
  m.contacts = {contact_between("pole", "zmin", "ball")};
  double before = 0;
  press(scene, [&](StepSpec& s, double depth) {
    s.displace = {far_away("outer", hertz_force(4 * mu, 1, depth), 0)};
    s.move = {shift("ball", {0, 0, depth - before}, before == 0 ? "touch" : "here")};
    before = depth;
  });
  return scene;
}

/// Two bodies whose surfaces are of radius 1 mm around the pole, one the image of the other.
Scene two_spheres(int n) {
  Scene scene;
  for (const auto& [name, up] : {std::pair{std::string("high"), 1.}, {"low", -1.}}) {
    Mesh half = half_space(n);
    for (Point& p : half.points) p[2] = up * (p[2] + (p[0] * p[0] + p[1] * p[1]) / 2);
    if (up < 0)
      for (auto& h : half.hexes) std::swap_ranges(h.begin(), h.begin() + 4, h.begin() + 4);
    std::map<std::string, std::vector<Quad>> surfaces;
    for (auto [side, faces] : half.surfaces) {
      if (up < 0)
        for (Quad& q : faces) std::swap(q[1], q[3]);
      surfaces[name + " " + side] = faces;
    }
    half.surfaces = surfaces, half.region_names = {name};
    up > 0 ? void(scene.mesh = half) : append(scene.mesh, half);
  }
  Model& m = scene.model;
  m.regions = {{"high", neo_hooke(c10)}, {"low", neo_hooke(c10)}};
  m.symmetry = {"x", "y"};
  m.contacts = {contact_between("pole", "high zmin", "low zmin")};
  press(scene, [](StepSpec& s, double depth) {
    const double force = hertz_force(2 * mu, .5, depth);
    s.displace = {far_away("high outer", force, depth), far_away("low outer", -force, 0)};
  });
  return scene;
}

struct HertzErrors {
  double force, area, mean;  ///< at the last depth; of the force, mean of the magnitudes over the depths
};

/// Contact area π R δ.
HertzErrors hertz_errors(const std::string& what, const Scene& scene, double modulus, double radius) {
  ContactTrial run(scene);
  run.settings.newton = tight(1e-8);
  std::size_t steps = 0;
  HertzErrors e{};
  run.watch = [&](const Increment& i, const State& state) {
    if (i.progress < 1) return;
    const double depth = depths[steps++];
    const ContactFigures f = run.contact("pole").figures(state);
    e.force = 4 * std::abs(f.on_master[0].force[2]) / hertz_force(modulus, radius, depth) - 1,
    e.area = 4 * f.area / (M_PI * radius * depth) - 1;
    e.mean += std::abs(e.force) / depths.size();
    measured(
        "Hertz, {}, {} hexahedra, depth / radius {:g}: force off by {:+.2f} %, contact area by {:+.1f} %; "
        "largest penetration {:.0e} of the depth",
        what, run.problem.mesh().all_hexes, depth, 100 * e.force, 100 * e.area, f.penetration / depth);
  };
  run.direct();
  EXPECT_TRUE(run.report.converged) << run.report.reason;
  EXPECT_EQ(steps, depths.size());
  return e;
}

TEST(Hertz, RigidBallOnAHalfSpace) {
  const HertzErrors coarse = hertz_errors("rigid ball", hertz(6), 4 * mu, 1),
                    fine = hertz_errors("rigid ball", hertz(9), 4 * mu, 1);
  measured(
      "Hertz, rigid ball, deepest: force off by {:.2f} % (target 2 %), area by {:.1f} % (target 5 %); "
      "observed order of the mean error of force {:.1f}",
      100 * fine.force, 100 * fine.area, std::log(coarse.mean / fine.mean) / std::log(1.5));
  EXPECT_LT(std::abs(fine.force), .02);
  EXPECT_LT(std::abs(fine.area), .05);
  EXPECT_LT(fine.mean, coarse.mean / 1.5);
}

TEST(Hertz, TwoEqualSpheres) {
  const HertzErrors e = hertz_errors("two equal spheres", two_spheres(9), 2 * mu, .5);
  EXPECT_LT(std::abs(e.force), .02);
  EXPECT_LT(std::abs(e.area), .05);
}

TEST(Ball, ReturnsToItsShapeWhenLetGo) {
  Scene scene{generate(BallShape{.radius = 1, .n = 4, .layers = 4}), {}};
  Model& m = scene.model;
  m.regions["ball"] = neo_hooke(c10);
  m.symmetry = {"x", "y", "z"};
  m.rigid_bodies["plate"].plane = PlaneShape{.point = {0, 0, 1.5}, .normal = {0, 0, -1}};
  m.contacts = {contact_between("pole", "outer", "plate")};
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
  measured(
      "ball pressed to 0.7 of its height (largest displacement {:.3f} of the radius, force {:.3f} mu R²) and "
      "let go: {:.0e} of the radius is left",
      most, force / mu, moved(run.state));
  EXPECT_GT(force, .5);
  EXPECT_LT(moved(run.state), 1e-8);
  EXPECT_EQ(run.pairs("pole"), 0);
}

}  // namespace
}  // namespace bulbus
