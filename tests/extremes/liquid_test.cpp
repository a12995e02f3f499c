// Liquids that are all but a gas or all but rigid, and cavities that are nearly empty.
#include "tests/extremes/spheres.hpp"

namespace bulbus {
namespace {

const std::vector<ShellLayer> wall{{10, 12, .0833}};

/// The stretch at which wall and liquid balance: p(la) = K (1 − la³ / (1 + beta)).
double closed_form(double K, double beta) {
  double low = 1, high = std::cbrt(1 + beta);
  for (int i = 0; i < 100; ++i) {
    const double la = (low + high) / 2, p = K * (1 - la * la * la / (1 + beta));
    (pressure_of(wall, la) < p ? low : high) = la;
  }
  return (low + high) / 2;
}

TEST(Liquid, OfAnyBulkModulus) {
  constexpr double beta = .1;
  for (double K : {1e-3, 1., 2083.3, 1e5, 1e7}) {
    const BothSolvers both(filled_layers(4, 2, wall, beta, K, 2));
    const Trial& run = both.run;
    ASSERT_TRUE(both.both()) << run.report.reason;
    const double la = closed_form(K, beta), p = pressure_of(wall, la);
    const double u = relative(stretch_of(run) - 1, la - 1), dp = relative(run.state.P[0], p);
    row("bulk modulus of the liquid", fmt::format("{:g} MPa", K), run,
        "u_r off by {:.1e}, P by {:.1e} of the closed form; {}", u, dp, both.compared());
    EXPECT_LT(u, .01);
    EXPECT_LT(dp, .01);
    EXPECT_LT(both.apart().places, 1e-5);
    EXPECT_LT(both.apart().pressures, 1e-5);
  }
}

TEST(Liquid, DrainedUntilTheCavityIsNearlyEmpty) {
  for (double left : {.5, .1, .01}) {
    const BothSolvers both(filled_layers(4, 2, wall, left - 1, 2083.3, 8), close_balance(), .02);
    const Trial& run = both.run;
    const double la = stretch_of(run);
    row("cavity drained", fmt::format("to {:g} of its volume", left), run,
        "{:.3f} of its volume left, P {:.4f} MPa (as a sphere {:.4f} MPa); {}{}", la * la * la,
        run.state.P[0], pressure_of(wall, la), both.compared(), both.stable() ? "" : "; not stable");
    EXPECT_LT(run.state.P[0], 0);
    EXPECT_FALSE(both.stable()) << "the wall folds";
    // beyond a half the answer is not unique: the run may stop, but not before that
    if (run.report.converged) {
      EXPECT_NEAR(la * la * la, left, 1e-3);
    }
    EXPECT_GT(la * la * la, left - 1e-3);
    EXPECT_LT(la * la * la, .5 + 1e-3);
    if (left < .5) continue;
    ASSERT_TRUE(both.both()) << run.report.reason << both.oracle.report.reason;
    EXPECT_LT(both.apart().places, 1e-5);
    EXPECT_LT(both.apart().pressures, 1e-5);
  }
}

}  // namespace
}  // namespace bulbus
