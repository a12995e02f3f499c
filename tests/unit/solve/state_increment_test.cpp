#include "core/solve/state_increment.hpp"

#include <gtest/gtest.h>

#include "tests/unit/solve/trial.hpp"

namespace bulbus {
namespace {

using namespace test;

std::vector<double> scaled(std::vector<double> v, double factor) {
  for (double& x : v) x *= factor;
  return v;
}

TEST(Extrapolation, GoesOnByAsMuch) {
  Trial run(filled_shell("half"), Comm(MPI_COMM_SELF));
  const State previous = run.problem.initial_state();
  ASSERT_EQ(previous.bodies.size(), 1u);
  State now = previous;
  const auto dx = noise_vector(now.x.size(), 1);
  const std::vector<double> dlambda = noise_vector(now.lambda.size(), 2), dP{.3};
  std::vector<double> q{.01, -.02, .03, .04, -.05, .06};
  const RigidBody& body = run.problem.dofs().bodies()[0];
  for (int i = 0; i < 6; ++i) q[i] = body.free()[i] ? q[i] : 0;
  ASSERT_EQ(move_without_inversion(run.problem, {scaled(dx, 1e-4), q, dlambda, dP}, now), 1);

  State expected = now;
  ASSERT_EQ(move_without_inversion(
                run.problem, {scaled(dx, 2e-4), scaled(q, 2), scaled(dlambda, 2), scaled(dP, 2)}, expected),
            1);
  extrapolate(run.problem, previous, 2, now);
  EXPECT_LT(relative_difference(now.x, expected.x), 1e-14);
  EXPECT_LT(relative_difference(now.lambda, expected.lambda), 1e-14);
  EXPECT_NEAR(now.P[0], .9, 1e-15);
  for (int i = 0; i < 9; ++i)
    EXPECT_NEAR(now.bodies[0].rotation(i / 3, i % 3), expected.bodies[0].rotation(i / 3, i % 3), 1e-14);
}

// A block pressed to .7 of its height in one increment would be of no height after 2.5 times as much more.
TEST(Extrapolation, StopsBeforeAnElementInverts) {
  Trial run(stretched_block(2, "-.3"), Comm(MPI_COMM_SELF));
  const State previous = run.problem.initial_state();
  State now = previous;
  for (std::size_t n = 0; n < now.x.size() / 3; ++n) now.x[3 * n + 2] *= .7;
  extrapolate(run.problem, previous, 2.5, now);
  EXPECT_NEAR(run.problem.solid().least_jacobian(now.x), .325, 1e-12);
}

TEST(March, ExtrapolatesWithinAStep) {
  Scene scene = stretched_block(2, "0.4");
  scene.model.steps[0].increments = 4;
  Trial without(scene), with(scene);
  without.settings.stepping.extrapolate = false;
  without.go(), with.go();
  ASSERT_TRUE(with.report.converged && without.report.converged);
  EXPECT_EQ(with.increments[0].newton.iterations.size(), without.increments[0].newton.iterations.size());
  EXPECT_LT(with.report.newton_iterations, without.report.newton_iterations);
  EXPECT_GT(without.increments[1].newton.iterations[0].prescribed, .09);
  EXPECT_LT(with.increments[1].newton.iterations[0].prescribed, 1e-12);  // the displacement grows linearly
  EXPECT_LT(relative_difference(with.state.x, without.state.x), 1e-9);
}

}  // namespace
}  // namespace bulbus
