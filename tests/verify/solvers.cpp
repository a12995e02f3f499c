// The iterative and the direct solver give one answer.
#include "core/mesh/eye.hpp"
#include "tests/support/small_eye.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

/// Largest differences, relative to the largest displacement, mean stress and pressure.
struct Differences {
  double u, lambda, P;
};

std::vector<double> displacements(const Trial& run) {
  std::vector<double> u(run.state.x);
  for (std::size_t i = 0; i < u.size(); ++i) u[i] -= run.problem.mesh().X[i];
  return u;
}

Differences compare(const char* what, const Scene& scene, double force, Trial* kept = nullptr) {
  Trial direct(scene), iterative(scene);
  direct.settings.newton = iterative.settings.newton = tight(force);
  direct.direct(), iterative.iterative();
  EXPECT_TRUE(direct.report.converged) << direct.report.reason;
  EXPECT_TRUE(iterative.report.converged) << iterative.report.reason;
  const Differences d{relative_difference(displacements(iterative), displacements(direct)),
                      relative_difference(iterative.state.lambda, direct.state.lambda),
                      relative_difference(iterative.state.P, direct.state.P)};
  measured("{}, iterative against direct ({} hexahedra): u {:.1e}, lambda {:.1e}, P {:.1e} (target 1e-6); P = {:.6e}; {} and {} Newton iterations, {} Krylov", what,
           direct.problem.mesh().all_hexes, d.u, d.lambda, d.P, direct.state.P[0], iterative.report.newton_iterations, direct.report.newton_iterations,
           iterative.report.krylov_iterations);
  EXPECT_LT(d.u, 1e-6);
  EXPECT_LT(d.lambda, 1e-6);
  EXPECT_LT(d.P, 1e-6);
  if (direct.increments.empty()) return d;
  // a stable state: one negative pivot for every pressure unknown
  for (const Increment& i : direct.increments)
    EXPECT_EQ(i.newton.negative_pivots, direct.problem.mesh().all_hexes + static_cast<long long>(direct.state.P.size())) << i.number;
  return d;
}

TEST(Solvers, AgreeOnTheFilledShell) {
  for (const char* part : {"octant", "half"}) {
    Scene scene = filled_shell(part);
    if (part == std::string("half")) scene.mesh.node_sets["seat"] = nodes_where(scene.mesh, [](const Point& p) { return p[2] < -.9 * norm(p); });
    if (part == std::string("half")) scene.model.fix.push_back({"seat", {"y", "z"}});
    scene.model.steps[1].add["fluid"] = 1;
    compare(part == std::string("half") ? "half shell" : "octant shell", scene, 1e-10);
  }
}

TEST(Solvers, AgreeOnTheHalfEye) { compare("half eye", small_eye(8), 1e-9); }

TEST(Solvers, AgreeOnTheHalfEyeWithARigidLens) {
  Scene scene = small_eye(6);
  scene.model.regions["lens"] = rigid();
  compare("half eye with a rigid lens", scene, 1e-9);
}

}  // namespace
}  // namespace bulbus
