// The iterative and the direct solver give one answer.
#include "app/eye/eye.hpp"
#include "tests/support/small_eye.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

std::vector<double> displacements(const Trial& run, const State& state) {
  std::vector<double> u(state.x);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] -= run.problem.mesh().X[i];
  return u;
}

/// A run that keeps the state of every increment.
struct Kept {
  Trial run;
  std::vector<State> states;
  Kept(const Scene& scene, bool direct, double force, Formulation formulation = Formulation::bordered)
      : run(scene) {
    run.settings.newton = tight(force);
    run.settings.linear.formulation = formulation;
    run.watch = [&](const Increment&, const State& s) { states.push_back(s); };
    direct ? run.direct() : run.iterative();
    EXPECT_TRUE(run.report.converged) << run.report.reason;
  }
};

/// Elimination is exact for the direct solver; the iterative one carries the dense block as a product.
TEST(Solvers, AgreeOnTheEliminatedShell) {
  Scene scene = filled_shell("octant");
  scene.model.steps[1].add["fluid"] = 1;
  const Kept bordered(scene, true, 1e-10);
  for (bool direct : {true, false}) {
    const Kept eliminated(scene, direct, 1e-10, Formulation::eliminated);
    ASSERT_EQ(eliminated.states.size(), bordered.states.size());
    const State &e = eliminated.states.back(), &b = bordered.states.back();
    const double u = relative_difference(displacements(eliminated.run, e), displacements(bordered.run, b)),
                 P = relative_difference(e.P, b.P);
    measured(
        "octant shell, P eliminated, {}, against bordered and direct: u {:.1e}, P {:.1e}; {} and {} Newton "
        "iterations, {} Krylov",
        direct ? "direct" : "iterative", u, P, eliminated.run.report.newton_iterations,
        bordered.run.report.newton_iterations, eliminated.run.report.krylov_iterations);
    EXPECT_LT(u, direct ? 1e-8 : 1e-6);
    EXPECT_LT(P, direct ? 1e-8 : 1e-6);
  }
}

/// Compares every state that is stable, that is: has one negative pivot for every pressure unknown. All
/// `must_be_stable` first ones have to be.
void compare(const std::string& what, const Scene& scene, double force, std::size_t must_be_stable) {
  const Kept direct(scene, true, force), iterative(scene, false, force);
  const long long expected =
      direct.run.problem.mesh().all_hexes + static_cast<long long>(direct.run.state.P.size());
  std::size_t stable = 0;
  while (stable < direct.states.size() && direct.run.increments[stable].newton.negative_pivots == expected)
    ++stable;
  ASSERT_GE(stable, must_be_stable) << direct.run.increments[stable].newton.negative_pivots
                                    << " negative pivots, not " << expected;
  ASSERT_GE(iterative.states.size(), stable);
  double u = 0, lambda = 0, P = 0;
  for (std::size_t i = 0; i < stable; ++i) {
    const State &d = direct.states[i], &k = iterative.states[i];
    ASSERT_NEAR(direct.run.increments[i].time, iterative.run.increments[i].time, 1e-12);
    u = worse(u, relative_difference(displacements(iterative.run, k), displacements(direct.run, d)));
    lambda = worse(lambda, relative_difference(k.lambda, d.lambda));
    P = worse(P, relative_difference(k.P, d.P));
  }
  measured(
      "{}, iterative against direct ({} hexahedra, {} of {} states stable): u {:.1e}, lambda {:.1e}, P "
      "{:.1e} (target 1e-6); {} and {} Newton iterations, {} Krylov",
      what, expected - 1, stable, direct.states.size(), u, lambda, P, iterative.run.report.newton_iterations,
      direct.run.report.newton_iterations, iterative.run.report.krylov_iterations);
  EXPECT_LT(u, 1e-6);
  EXPECT_LT(lambda, 1e-6);
  EXPECT_LT(P, 1e-6);
}

TEST(Solvers, AgreeOnTheFilledShell) {
  for (const std::string part : {"octant", "half"}) {
    Scene scene = filled_shell(part);
    if (part == "half") {
      scene.mesh.node_sets["seat"] =
          nodes_where(scene.mesh, [](const Point& p) { return p[2] < -.9 * norm(p); });
      scene.model.fix.push_back({"seat", {"y", "z"}});
    }
    scene.model.steps[1].add["fluid"] = 1;
    compare(part + " shell with bars and a rigid cap", scene, 1e-10, 2);
  }
}

/// A band that may slide along the eye loses its stability at about 1 mm: from there on no answer is the only
/// one.
TEST(Solvers, AgreeOnTheHalfEyeAsLongAsASlidingBandIsStable) {
  compare("half eye, sliding band", small_eye(6), 1e-9, 2);
}

TEST(Solvers, AgreeOnTheHalfEyeUnderAFixedBand) {
  compare("half eye, fixed band", held_band(small_eye(6)), 1e-9, 5);
}

TEST(Solvers, AgreeOnTheHalfEyeWithARigidLens) {
  Scene scene = held_band(small_eye(6));
  scene.model.regions["lens"] = rigid();
  compare("half eye, rigid lens, fixed band", scene, 1e-9, 5);
}

}  // namespace
}  // namespace bulbus
