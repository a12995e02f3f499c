#include "app/eye/eye_optics.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "app/eye/corneal_fit.hpp"
#include "core/base/error.hpp"
#include "tests/support/small_eye.hpp"

namespace bulbus {
namespace {

using std::numbers::pi;

/// The vertex of the torus of two radii (mm) whose meridian of the first is at an angle, by points up to a
/// distance from the axis.
CornealVertex of_torus(double along, double across, double angle, double farthest) {
  CornealSums sums;
  const int m = 20;
  for (int i = -m; i <= m; ++i)
    for (int j = -m; j <= m; ++j) {
      const double u = farthest * i / m, v = farthest * j / m;
      if (std::hypot(u, v) > farthest) continue;
      const double arm = along - across + std::sqrt(across * across - v * v);
      sums.add({u * std::cos(angle) - v * std::sin(angle), u * std::sin(angle) + v * std::cos(angle),
                3 + std::sqrt(arm * arm - u * u)});
    }
  return fitted_cornea(sums);
}

TEST(CornealFit, IsExactOnASphere) {
  CornealSums sums;
  for (int i = 1; i < 40; ++i) {
    const double tilt = .01 * i, turn = i;
    sums.add({.1 + 7.8 * std::sin(tilt) * std::cos(turn), -.2 + 7.8 * std::sin(tilt) * std::sin(turn),
              5 + 7.8 * std::cos(tilt)});
  }
  const CornealVertex v = fitted_cornea(sums);
  EXPECT_NEAR(v.steep, 1 / 7.8, 1e-8);
  EXPECT_NEAR(v.flat, 1 / 7.8, 1e-8);
  EXPECT_NEAR(v.z, 5 + std::sqrt(7.8 * 7.8 - .05), 1e-9);
}

/// Both radii and the meridian of a toric surface, nearer to the vertex the better.
TEST(CornealFit, FindsThePrincipalCurvaturesOfATorus) {
  const double angle = .7;
  for (const auto& [zone, error] : {std::pair{3., .03}, {.6, .0012}}) {
    const CornealVertex v = of_torus(7.5, 8, angle, zone / 2);
    EXPECT_NEAR(v.steep - v.flat, 1 / 7.5 - 1 / 8., error * (1 / 7.5 - 1 / 8.)) << zone;
    EXPECT_NEAR(v.steep, 1 / 7.5, error / 7.5) << zone;
    EXPECT_NEAR(v.meridian, angle, 1e-6) << zone;
  }
  EXPECT_NEAR(of_torus(8, 7.5, angle, 1.5).meridian, angle + pi / 2, 1e-6);
}

/// A single refracting surface, and that a longer eye is myopic: by 2.7 D/mm with the lens of Gullstrand's
/// eye.
TEST(Refraction, IsTheVergenceAtTheCornea) {
  EXPECT_NEAR(refraction(43, 0, 5, 24), 1336. / 24 - 43, 1e-12);
  EXPECT_NEAR(refraction(43, 19, 0, 24), 1336. / 24 - 43 - 19, 1e-12);  // lenses in one place add up
  const double change = refraction(43.05, 19.11, 5.7, 24.5) - refraction(43.05, 19.11, 5.7, 23.5);
  EXPECT_LT(change, -2.5);
  EXPECT_GT(change, -2.8);
  EXPECT_LT(refraction(44, 19, 5, 24), refraction(43, 19, 5, 24));
}

ProbeSpec probe(const std::string& kind) {
  ProbeSpec p;
  p.name = p.kind = kind;
  p.set = "outer_cornea", p.to = "retina_pole", p.region = "lens";
  return p;
}

/// Of the generated eye, mapped; the half eye is the whole one.
std::vector<double> figures(const std::vector<ProbeSpec>& probes, const Point& stretch) {
  Scene scene = small_eye(8);
  scene.model.probes = probes;
  Problem problem(scene.mesh, scene.model, Comm());
  State state = problem.initial_state();
  for (std::size_t i = 0; i < state.x.size(); ++i) state.x[i] *= stretch[i % 3];
  return ProbeSet(problem, optical_probes()).values(problem, state);
}

TEST(EyeOptics, MeasureTheDrawnEye) {
  const EyeShape shape;
  const auto v =
      figures({probe("corneal_power"), probe("corneal_astigmatism"), probe("refraction")}, {1, 1, 1});
  EXPECT_NEAR(v[0], 337.5 / shape.cornea_radius, 1e-5);
  EXPECT_NEAR(v[1], 0, 1e-5);
  EXPECT_GT(v[2], -3);
  EXPECT_LT(v[2], 3);
}

/// An ellipsoid with half axes R, s R, R has the curvatures 1/R along x and 1/(s² R) along y at the end of
/// its third axis; its cornea is that up to where its centre lies.
TEST(EyeOptics, SeeAstigmatism) {
  const double s = 1.02, R = EyeShape{}.cornea_radius;
  ProbeSpec meridian = probe("steep_meridian");
  meridian.unit = "deg";
  const auto v = figures({probe("corneal_power"), probe("corneal_astigmatism"), meridian}, {1, s, 1});
  EXPECT_NEAR(v[0], 337.5 / R * (1 + 1 / (s * s)) / 2, .04);
  EXPECT_NEAR(v[1], 337.5 / R * (1 - 1 / (s * s)), .04);
  EXPECT_NEAR(std::fmod(v[2] + 90, 180), 90, 1e-6);
}

TEST(EyeOptics, ALongerEyeIsMyopic) {
  const auto before = figures({probe("refraction")}, {1, 1, 1}),
             after = figures({probe("refraction")}, {1, 1, 1.01});
  EXPECT_LT(after[0], before[0]);
}

TEST(EyeOptics, RefuseAZoneWithTooFewNodes) {
  ProbeSpec narrow = probe("corneal_power");
  narrow.zone = .5;
  try {
    figures({narrow}, {1, 1, 1});
    ADD_FAILURE();
  } catch (const InputError& fault) {
    EXPECT_EQ(fault.key, "probes.0.zone");
    EXPECT_NE(std::string(fault.what()).find("too few"), std::string::npos) << fault.what();
  }
}

}  // namespace
}  // namespace bulbus
