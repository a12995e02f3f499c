#include "contact/elastic_band.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "contact/band_tension.hpp"
#include "contact/rigid/rigid_motion.hpp"
#include "core/base/error.hpp"
#include "tests/unit/contact/bodies.hpp"

namespace bulbus {
namespace {

constexpr double turn = 2 * std::numbers::pi;

RigidBodySpec ring(int parts, double to) {
  BandShape band;
  band.arc = {.from = 0, .to = to, .parts = parts, .facets = 3};
  return {.band = band};
}

/// A pressure p on the width w of a ring of radius r: on an arc of the angle α it is 2 p w r sin(α/2)
/// outwards.
TEST(BandTension, IsPressureTimesWidthTimesRadius) {
  const double p = .01, w = 2, r = 12;
  for (const auto& [parts, to] : {std::pair{36, 360.}, {18, 180.}, {10, 100.}, {2, 180.}, {1, 180.}}) {
    const RigidBodySpec spec = ring(parts, to);
    const RigidSurface band = body(spec);
    const double angle = turn * to / 360 / parts, on_arc = 2 * p * w * r * std::sin(angle / 2);
    std::vector<Wrench> forces;
    for (const auto& part : band.parts) forces.push_back({-on_arc * part.inwards, {}});
    EXPECT_NEAR(band_tension(band, {band_opening(spec, "band", "")}, forces), p * w * r, 1e-9 * p * w * r);
  }
}

// The ends of a rigid arc of the half angle h come together by 2 sin h per closing.
TEST(BandTension, ShorteningIsThatOfTheArcsEnds) {
  EXPECT_NEAR(body(ring(1, 180)).shortening, 4, 1e-12);
  EXPECT_NEAR(body(ring(6, 180)).shortening, 24 * std::sin(turn / 24), 1e-12);
}

// Arcs that a quarter of a turn about the band's axis has brought to each other's places.
TEST(BandTension, TurnsWithTheBand) {
  const auto band = std::make_shared<RigidSurface>(body(ring(36, 360)));
  RigidMotion motion(band);
  motion.begin({.body = "b", .rotate = RotationSpec{.angle = turn / 4}}, {}, "");
  motion.set_progress(1);
  std::vector<Wrench> forces;
  for (const auto& part : band->parts)
    forces.push_back({{part.inwards[1], -part.inwards[0], -part.inwards[2]}, {}});
  EXPECT_NEAR(band_tension(*band, {turn}, forces), 1 / (2 * std::sin(turn / 72)), 1e-9);
}

TEST(BandTension, NeedsArcsThatCloseRadially) {
  RigidBodySpec shifted = ring(4, 90);
  shifted.direction = {0, -1, 0};
  for (const RigidBodySpec& spec :
       {shifted, ring(1, 360), ring(1, 200), RigidBodySpec{.sphere = SphereShape{}}}) {
    try {
      band_opening(spec, "tire", "body");
      ADD_FAILURE();
    } catch (const InputError& fault) {
      EXPECT_EQ(fault.key, "body");
    }
  }
}

/// Around what presses with the hoop force T(c), over increments of two steps.
template <class Pressed>
void expect_balanced(double stiffness, Pressed pressed) {
  const double C = turn * 12, D = 6;
  ElasticBand band(stiffness, turn);
  band.shorten(C, D);
  double before = 0;
  int updates = 0;
  for (int step = 0; step < 2; ++step) {
    for (double s : {.25, .5, .75, 1.}) {
      band.set_progress(s);
      while (band.balance(pressed(before + band.closing()))) ++updates;
      const double closed = before + band.closing(), shortened = step == 0 ? s * D : D;
      const double expected = stiffness * (shortened - turn * closed) / (C - shortened);
      EXPECT_FALSE(band.gave_up());
      EXPECT_NEAR(band.tension(), expected, 1e-12);
      EXPECT_NEAR(pressed(closed), expected, 1.1e-4 * expected) << stiffness << ' ' << step << ' ' << s;
      band.commit();
    }
    before += band.closing();
    band.freeze();
  }
  EXPECT_LE(updates, 24);
}

TEST(ElasticBand, BalancesWhatItPressesOn) {
  for (double stiffness : {.1, 3., 1e4}) {
    expect_balanced(stiffness, [](double c) { return .5 * std::max(0., c); });
    expect_balanced(stiffness, [](double c) { return c > 0 ? .3 * std::pow(c, 1.5) * std::exp(c) : 0; });
  }
}

// What shrinks away from it is followed as far as the state is extrapolated; without that it stays.
TEST(ElasticBand, GoesOnWithAnExtrapolatedState) {
  ElasticBand band(3, turn);
  band.shorten(turn * 12, 6);
  const auto balanced_with = [&](double s, double shrunk) {
    band.set_progress(s);
    while (band.balance(.5 * std::max(0., band.closing() - shrunk))) {
    }
    band.commit();
    return band.closing();
  };
  balanced_with(1, 0);
  band.freeze();
  const double first = balanced_with(.25, .02);
  band.set_progress(.5);
  EXPECT_EQ(band.closing(), first);
  band.extrapolate(2);
  band.set_progress(.75);
  EXPECT_NEAR(band.closing(), 3 * first, 1e-12);
  band.set_progress(.5);
  EXPECT_EQ(band.closing(), first) << "once";
}

/// A step that does not shorten it is one in which what it presses on has changed.
TEST(ElasticBand, GivesWayToWhatSwells) {
  ElasticBand band(3, turn);
  band.shorten(turn * 12, 6);
  double before = 0;
  for (double swollen : {0., .2}) {
    band.set_progress(1);
    while (band.balance(.5 * (before + band.closing() + swollen))) {
    }
    const double moved = band.closing();
    EXPECT_FALSE(band.gave_up());
    EXPECT_GT(swollen > 0 ? -moved : moved, .01);
    band.commit();
    band.freeze();
    before += moved;
  }
}

TEST(ElasticBand, SaysWhenNothingBalances) {
  ElasticBand band(3, turn);
  band.shorten(turn * 12, 6);
  band.set_progress(1);
  int k = 0;
  while (band.balance(++k % 2 ? 1 : 0)) {
  }
  EXPECT_TRUE(band.gave_up());
}

}  // namespace
}  // namespace bulbus
