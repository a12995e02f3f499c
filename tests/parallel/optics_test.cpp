// Probes of the eye however many ranks: of a prescribed state, on every rank by itself and together.
#include <gtest/gtest.h>

#include "app/eye/eye_optics.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

std::vector<double> figures(const Scene& scene, const Comm& comm) {
  Problem problem(scene.mesh, scene.model, comm);
  State state = problem.initial_state();
  for (std::size_t i = 0; i < state.x.size(); i += 3) state.x[i + 1] *= 1 + .001 * state.x[i + 2];
  return ProbeSet(problem, optical_probes()).values(problem, state);
}

TEST(EyeOptics, DoNotDependOnTheRanks) {
  Scene scene = small_eye(6);
  for (const char* kind :
       {"corneal_power", "corneal_astigmatism", "steep_meridian", "refraction", "buckle_height"}) {
    ProbeSpec p;
    p.name = p.kind = kind;
    p.set = "outer_cornea", p.to = "retina_pole", p.region = "lens";
    scene.model.probes.push_back(p);
  }
  scene.model.probes.back().to = "equator";
  const auto alone = figures(scene, Comm(MPI_COMM_SELF)), together = figures(scene, Comm());
  ASSERT_EQ(alone.size(), 5u);
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_NEAR(together[i], alone[i], 1e-8 * (1 + std::abs(alone[i]))) << scene.model.probes[i].kind;
    EXPECT_NE(alone[i], 0) << scene.model.probes[i].kind;
  }
}

}  // namespace
}  // namespace bulbus
