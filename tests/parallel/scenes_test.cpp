// The same figures however many ranks: every rank solves the scene by itself, directly, then all solve it
// together.
#include "tests/support/small_eye.hpp"
#include "tests/verify/run.hpp"

namespace bulbus {
namespace {

ProbeSpec probe(const std::string& kind) {
  ProbeSpec p;
  p.name = p.kind = kind;
  return p;
}

/// Pressure and volume of the liquid, largest displacement of `set`, largest and 99 % Mises stress, squeeze
/// on `held`.
void add_probes(Model& model, const std::string& set, const std::string& held) {
  ProbeSpec pressure = probe("pressure"), volume = probe("volume"), largest = probe("displacement"),
            mises = probe("mises"), most = probe("mises"), squeeze = probe("reaction");
  pressure.liquid = volume.liquid = model.liquids.begin()->first;
  largest.set = set, largest.statistic = "max";
  most.name = "mises of 99 %", most.percentile = 99;
  squeeze.set = held, squeeze.component = "radial";
  model.probes = {pressure, volume, largest, mises, most, squeeze};
}

Scene shell() {
  Scene scene = filled_shell("half");
  scene.mesh.node_sets["seat"] = nodes_where(scene.mesh, [](const Point& p) { return p[2] < -.9 * norm(p); });
  scene.model.fix.push_back({"seat", {"y", "z"}});
  scene.model.steps[1].add["fluid"] = 1;
  add_probes(scene.model, "outer", "pulled");
  return scene;
}

Scene eye() {
  Scene scene = held_band(small_eye(4));
  scene.model.steps[1].increments = 1;
  scene.model.steps[1].displace[0].radial = "-0.5";
  add_probes(scene.model, "outside", "equator_band");
  return scene;
}

void expect_same_figures(const char* what, const Scene& scene, double force,
                         Formulation formulation = Formulation::bordered) {
  Trial alone(scene, Comm(MPI_COMM_SELF));
  alone.settings.newton = tight(force);
  alone.direct();
  ASSERT_TRUE(alone.report.converged) << alone.report.reason;
  const ProbeSet probes(alone.problem);
  const auto expected = probes.values(alone.problem, alone.state);
  for (bool direct : {true, false}) {
    Trial together(scene);
    together.settings.newton = tight(force);
    together.settings.linear.formulation = formulation;
    direct ? together.direct() : together.iterative();
    ASSERT_TRUE(together.report.converged) << together.report.reason;
    const auto found = ProbeSet(together.problem).values(together.problem, together.state);
    ASSERT_EQ(found.size(), scene.model.probes.size());
    std::string figures;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_LT(relative(found[i], expected[i]), 1e-8) << probes.name(i);
      figures +=
          fmt::format("{} {:.8g} ({:.0e}), ", probes.name(i), found[i], relative(found[i], expected[i]));
    }
    EXPECT_EQ(together.report.increments, alone.report.increments);
    measured("{}, {} ranks, {}, against direct alone: {}{} Newton iterations ({}), {} Krylov", what,
             together.comm.size(), direct ? "direct" : "iterative", figures,
             together.report.newton_iterations, alone.report.newton_iterations,
             together.report.krylov_iterations);
  }
}

TEST(Ranks, DoNotMatterToAShellWithARigidCapBarsAndSkewHolds) {
  expect_same_figures("half shell", shell(), 1e-11);
}

TEST(Ranks, DoNotMatterToAShellWhoseLiquidIsEliminated) {
  expect_same_figures("half shell, P eliminated", shell(), 1e-11, Formulation::eliminated);
}

TEST(Ranks, DoNotMatterToSuperLuDist) {
  const Scene scene = shell();
  Trial alone(scene, Comm(MPI_COMM_SELF)), together(scene);
  together.settings.linear.direct = Direct::superlu_dist;
  for (Trial* t : {&alone, &together}) {
    t->settings.newton = tight(1e-11);
    t->direct();
    ASSERT_TRUE(t->report.converged) << t->report.reason;
  }
  const ProbeSet probes(alone.problem);
  const auto expected = probes.values(alone.problem, alone.state),
             found = ProbeSet(together.problem).values(together.problem, together.state);
  ASSERT_EQ(found.size(), scene.model.probes.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_LT(relative(found[i], expected[i]), 1e-8) << probes.name(i);
}

TEST(Ranks, DoNotMatterToTheHalfEye) { expect_same_figures("half eye", eye(), 1e-9); }

}  // namespace
}  // namespace bulbus
