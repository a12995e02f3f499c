// Tangents that are not definite, on any number of ranks: the answer is the direct solver's on one.
#include "tests/support/not_empty.hpp"
#include "tests/verify/contact_trial.hpp"

namespace bulbus {
namespace {

Scene with_probes(Scene scene) {
  for (const auto& [kind, set] :
       {std::pair{"displacement", "xmax"}, {"displacement", "ymax"}, {"mises", ""}}) {
    ProbeSpec p;
    p.name = std::string(kind) + set, p.kind = kind, p.set = set, p.statistic = "max";
    scene.model.probes.push_back(p);
  }
  return scene;
}

// To twice its length at once: beyond what the tangent of the first iterates bears.
Scene pulled_block(int n) { return with_probes(stretched_block(n, "1")); }

// c01 < 0: pulled in two directions it passes its largest force at √6 and is not stable beyond.
Scene unstable_block() {
  Scene scene = pulled_block(2);
  for (auto& [name, law] : scene.model.regions) law.c10 = .06, law.c01 = -.01;
  StepSpec& pull = scene.model.steps[0];
  DisplaceSpec along_x = displace("xmax");
  along_x.x = pull.displace[0].z = "1.8";
  pull.displace.push_back(along_x);
  pull.increments = 8;
  return scene;
}

// Returns how many systems MUMPS solved.
int expect_as_direct(const Scene& scene, const char* what) {
  ContactTrial alone(scene, Comm(MPI_COMM_SELF)), together(scene);
  alone.direct(), together.iterative();
  EXPECT_TRUE(alone.report.converged) << alone.report.reason;
  EXPECT_TRUE(together.report.converged) << together.report.reason;
  EXPECT_EQ(together.report.cuts, alone.report.cuts);
  const auto expected = ProbeSet(alone.problem).values(alone.problem, alone.state);
  const auto found = ProbeSet(together.problem).values(together.problem, together.state);
  EXPECT_EQ(found.size(), scene.model.probes.size());
  double worst = 0;
  for (std::size_t i = 0; i < found.size(); ++i) worst = worse(worst, relative(found[i], expected[i]));
  EXPECT_LT(worst, 1e-6);
  int direct_solves = 0;
  for (std::size_t i = 0; i < std::min(alone.increments.size(), together.increments.size()); ++i) {
    const NewtonReport &a = alone.increments[i].newton, &b = together.increments[i].newton;
    direct_solves += b.direct_solves;
    EXPECT_EQ(b.negative_pivots, a.negative_pivots) << i;
  }
  measured("{}, {} ranks: {} Newton iterations ({}), {} Krylov, {} direct solves, worst probe {:.0e}", what,
           together.comm.size(), together.report.newton_iterations, alone.report.newton_iterations,
           together.report.krylov_iterations, direct_solves, worst);
  return direct_solves;
}

TEST(Fallback, PulledBlocksAreSolvedOnAnyNumberOfRanks) {
  for (int n : {2, 3, 4}) expect_as_direct(pulled_block(n), "pulled block");
}

TEST(Fallback, AnUnstableBlockIsFollowedAndItsPivotsAreTold) {
  expect_as_direct(unstable_block(), "unstable block");
}

// Three iterations are never enough: all is MUMPS's.
TEST(Fallback, MumpsSolvesWhatGmresLeaves) {
  Scene scene = filled_shell("half");
  ContactTrial alone(scene, Comm(MPI_COMM_SELF)), together(scene), refused(scene);
  alone.direct();
  for (ContactTrial* t : {&together, &refused}) t->settings.linear.max_iterations = 1;
  together.iterative();
  ASSERT_TRUE(alone.report.converged && together.report.converged)
      << alone.report.reason << together.report.reason;
  EXPECT_EQ(together.report.newton_iterations, alone.report.newton_iterations);
  EXPECT_LT(relative(together.state.P[0], alone.state.P[0]), 1e-8);
  for (const Increment& i : not_empty(together.increments)) EXPECT_GT(i.newton.direct_solves, 0);
  refused.settings.linear.memory_limit = 1;  // MB
  refused.iterative();
  EXPECT_FALSE(refused.report.converged);
  EXPECT_NE(refused.report.reason.find("GMRES"), std::string::npos) << refused.report.reason;
}

TEST(Fallback, KnowsEliminatedPressuresToo) {
  Scene scene = filled_shell("half");
  ContactTrial alone(scene, Comm(MPI_COMM_SELF)), together(scene);
  alone.direct();
  together.settings.linear.formulation = Formulation::eliminated;
  together.settings.linear.max_iterations = 1;
  together.iterative();
  ASSERT_TRUE(alone.report.converged && together.report.converged)
      << alone.report.reason << together.report.reason;
  for (const Increment& i : not_empty(together.increments)) EXPECT_GT(i.newton.direct_solves, 0);
  EXPECT_LT(relative(together.state.P[0], alone.state.P[0]), 1e-8);
}

}  // namespace
}  // namespace bulbus
