#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact/rigid/profile.hpp"
#include "contact/rigid/rigid_shapes.hpp"
#include "contact/surfaces/meridians.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/support/sheets.hpp"
#include "tests/support/term_tangent.hpp"

namespace bulbus {
namespace {

constexpr double penalty = 20;

ContactTerm term_of(const Sheets& s, const std::vector<Quad>& slave,
                    std::shared_ptr<const RigidSurface> rigid) {
  return ContactTerm(contact_spec(penalty, .2), {.penalty = 0, .depth = 0, .reach = .6},
                     {s.X, s.nodes(), slave, Master(std::move(rigid)), {}}, Comm());
}

/// A strip of slave faces along a curve in x and z with its normal to the left, 1 wide in y.
struct Strip {
  Sheets sheets;
  std::vector<Quad> faces;
  template <class Curve>
  Strip(int n, Curve curve) {
    faces = sheets.add(2, n, [&](double u, double v) {
      const auto [x, z] = curve(v);
      return Vec3<double>{x, u - .5, z};
    });
  }
};

// The contour of a box of half widths 1 and .5, `inside` it, from the middle of the top to the middle of the
// right side.
std::array<double, 2> around_the_edge(double s, double inside) {
  const double top = 1 - inside, side = .5 - inside, at = s * (top + side);
  return at < top ? std::array{at, side} : std::array{top, side - (at - top)};
}

TEST(RigidContact, LosesNoNodeThatSlidesOverABoxEdge) {
  const auto rigid = box(1, .5, 3);
  const double inside = .02;
  for (double shift = 0; shift < .1; shift += .003) {
    const Strip strip(10, [&](double v) { return around_the_edge(shift + .9 * v, inside); });
    const auto term = term_of(strip.sheets, strip.faces, rigid);
    const State state = strip.sheets.state();
    EXPECT_EQ(term.figures(state).pairs, strip.sheets.nodes()) << shift;
    EXPECT_NEAR(term.figures(state).penetration, inside, 1e-12) << shift;
  }
}

// Between the chords of a ring's inner face and the circle that they stand for a point is in front of the
// face.
TEST(RigidContact, HollowFacesKeepOutWhatBeganBeforeTheirTriangles) {
  RigidBodySpec spec;
  spec.band = BandShape{.width = 2, .thickness = .75, .edge_radius = 1e-3, .radius = 12};
  spec.band->arc = {.from = -15, .to = 45, .parts = 1, .facets = 24};
  const auto ring =
      std::make_shared<const RigidSurface>(make_rigid_surface("ring", spec, "rigid_bodies.ring"));
  const double sag = 12 * (1 - std::cos(std::numbers::pi / 144));
  const auto ball_at = [&](double gap) {
    Sheets s;
    s.add(8, 40, [&](double u, double v) {
      const double a = (3 + 24 * v) * std::numbers::pi / 180, r = 12 - gap;
      return Vec3<double>{r * std::sin(a), r * std::cos(a), .5 * (u - .5)};
    });
    return s;
  };
  const Sheets ball = ball_at(.3 * sag);
  auto term = term_of(ball, Sheets{}.add(8, 40, [](double, double) { return Vec3<double>{}; }), ring);
  for (double deep : {.1, 1., 5.}) {
    term.begin_step(0, ball_at(1).state());  // farther than the reach
    term.begin_step(1, ball.state());        // which the ring has been brought to
    EXPECT_EQ(term.figures(ball.state()).pairs, 0);
    const State inside = ball_at(-deep * sag).state();
    EXPECT_EQ(term.figures(inside).pairs, ball.nodes()) << deep;
    EXPECT_NEAR(term.figures(inside).penetration, deep * sag, .06 * sag);
  }
}

// A gap is a distance: it changes by no more than the point moves, whichever triangle the point is measured
// from.
TEST(RigidContact, GapsGoOnOverTheRimOfACurvedBodysEnd) {
  const BandShape shape{.width = 2, .thickness = .75, .edge_radius = .2, .radius = 12};
  RigidBodySpec spec;
  spec.swept = SweptShape{.arc = {.from = 0, .to = 30, .facets = 12}};
  for (const Point2& corner : profile_of(shape, "")) spec.swept->section.push_back({corner[0], corner[1]});
  const auto band =
      std::make_shared<const RigidSurface>(make_rigid_surface("band", spec, "rigid_bodies.band"));
  const double end = 1e-5, step = 2e-4;
  // a small face that looks towards the edge of the inner face and the end, its place by depths in both and
  // by z
  const auto face_at = [&](double radial, double azimuthal, double z) {
    Sheets s;
    const double a = azimuthal / 12;
    const Vec3<double> x{(12 + radial) * std::sin(a), (12 + radial) * std::cos(a), z};
    s.add(2, 2, [&](double u, double v) { return x + Vec3<double>{end * v, -end * v, end * u}; });
    return s;
  };
  const auto faces = Sheets{}.add(2, 2, [](double, double) { return Vec3<double>{}; });
  for (double z : {0., .3, .79, .81}) {
    const Sheets first = face_at(.03, .015, z);
    auto term = term_of(first, faces, band);
    double before = 0;
    for (int k = 0; k <= 100; ++k) {
      const double way = k * step;
      const State state = face_at(.03 - way / 4, .015 + way, z + way / 3).state();
      const double gap = term.nodes(state)[0].gap;
      if (k > 0) {
        EXPECT_LT(std::abs(gap - before), 1.2 * step) << z << " " << k;
      }
      EXPECT_LT(gap, 0) << z << " " << k;
      before = gap;
      term.commit(state);
    }
  }
}

TEST(RigidContact, SlidesRoundACylinder) {
  const auto rigid = cylinder(40, 2, 3);
  const double sagitta = 2 * (1 - std::cos(M_PI / 40));
  auto term_at = [&](double turn, double radius) {
    const Strip strip(7, [=](double v) {
      const double a = turn - v;
      return std::array{radius * std::cos(a), radius * std::sin(a)};
    });
    return std::pair{term_of(strip.sheets, strip.faces, rigid), strip.sheets.state()};
  };
  for (double turn = 0; turn < 7; turn += .05) {
    const auto [term, state] = term_at(turn, 1.95);
    const ContactFigures f = term.figures(state);
    ASSERT_EQ(f.pairs, 24) << turn;
    EXPECT_LE(f.penetration, .05 + 2e-4);  // at an edge the plane of the next facet may be taken
    EXPECT_GE(f.penetration, .05 - sagitta);
    const auto [above, free] = term_at(turn, 2.01);
    EXPECT_EQ(above.figures(free).pairs, 0) << turn;
  }
}

/// One face sunk into the top of a box.
struct OnABox : testing::Test {
  std::shared_ptr<RigidSurface> rigid = box(1, .5, 3);
  Sheets sheets;
  std::vector<Quad> faces = sheets.add(3, 3, [](double u, double v) {
    return Vec3<double>{.6 * v - .4, .6 * u - .3, .49 + .005 * u};
  });
  ContactTerm term = term_of(sheets, faces, rigid);
  State state = sheets.state();
};

TEST_F(OnABox, VisitsOneNodePerPair) {
  int pairs = 0;
  tangent_at(term, state)->visit([&](std::span<const int> nodes, std::span<const double> K) {
    ++pairs;
    ASSERT_EQ(nodes.size(), 1u);
    ASSERT_EQ(K.size(), 9u);
    EXPECT_GT(K[8], 0);
    EXPECT_NEAR(K[0], 0, 1e-12);
  });
  EXPECT_EQ(pairs, 16);
}

TEST_F(OnABox, ActionIsTheDerivativeOfTheForce) {
  const auto d = noise_vector(state.x.size(), 3);
  const auto f = action(term, state, d);
  const auto exact = derivative(
      [&](std::span<const double> x) {
        std::vector<double> r(x.size());
        term.add_residual({{x.begin(), x.end()}, {}, {}, {}}, r, {});
        return r;
      },
      state.x, d, 1e-4);
  EXPECT_LT(relative_difference(f, exact), 1e-9);
}

TEST_F(OnABox, FollowsTheBodysMotion) {
  const double before = term.figures(state).on_master[0].force[2];
  EXPECT_LT(before, 0);
  const auto lift = [&](double by) {
    for (std::size_t i = 2; i < rigid->places.size(); i += 3) rigid->places[i] += by;
    ++rigid->moves;
  };
  lift(.03);
  EXPECT_NEAR(term.figures(state).on_master[0].force[2], before - penalty * .03 * .6 * .6, 1e-4);
  lift(-.1);
  EXPECT_EQ(term.figures(state).pairs, 0);
}

TEST_F(OnABox, TouchesEveryPartForItself) {
  // the same box twice as two parts, the second lower by .004
  auto two = std::make_shared<RigidSurface>(*rigid);
  const int points = static_cast<int>(two->places.size() / 3),
            triangles = static_cast<int>(two->facets.triangles.size());
  for (int i = 0; i < 3 * points; ++i) two->places.push_back(two->places[i] - (i % 3 == 2 ? .004 : 0));
  auto all = two->facets.triangles;
  for (int t = 0; t < triangles; ++t) {
    auto copy = all[t];
    for (int& n : copy) n += points;
    all.push_back(copy);
  }
  two->facets = make_facets(all);
  two->parts.push_back(
      {.first_point = points, .points = points, .first_triangle = triangles, .triangles = triangles});
  const auto both = term_of(sheets, faces, two);
  const ContactFigures one = term.figures(state), sum = both.figures(state);
  EXPECT_EQ(sum.pairs, 32);
  ASSERT_EQ(sum.on_master.size(), 2u);
  EXPECT_NEAR(sum.on_master[0].force[2], one.on_master[0].force[2], 1e-13);
  EXPECT_NEAR(sum.on_master[1].force[2], one.on_master[0].force[2] + penalty * .004 * .36, 1e-4);
  EXPECT_NEAR(sum.area, one.area, 1e-14);
}

/// A plate of area A = .36 held by a spring k above the box, pushed down by w.
struct PlateOnSpring : OnABox {
  double k = 3, A = .36, w = -.05, z = 0;
  PlateOnSpring() {
    for (std::size_t i = 2; i < sheets.X.size(); i += 3) sheets.X[i] = .5;
  }
  ContactTerm augmented(double tolerance) {
    return ContactTerm(
        contact_spec(penalty, .2, tolerance), {.penalty = 0, .depth = 0, .reach = .6},
        {sheets.X, sheets.nodes(), faces, Master(std::shared_ptr<const RigidSurface>(rigid)), {}}, Comm());
  }
  State at(double height) const {
    State s = sheets.state();
    for (std::size_t i = 2; i < s.x.size(); i += 3) s.x[i] += height;
    return s;
  }
  // k (z − w) + contact = 0
  void equilibrate(const ContactTerm& term) {
    for (int i = 0; i < 30; ++i) {
      const double contact = term.figures(at(z)).on_master[0].force[2];
      z -= (k * (z - w) + contact) / (k + (contact < 0 ? penalty * A : 0));
    }
    EXPECT_NEAR(k * (z - w) + term.figures(at(z)).on_master[0].force[2], 0, 1e-12);
  }
};

TEST_F(PlateOnSpring, PenaltyAloneLeavesThePenetrationOfItsSpring) {
  auto term = augmented(0);
  equilibrate(term);
  EXPECT_NEAR(z, k * w / (k + penalty * A), 1e-10);
  EXPECT_FALSE(term.update_multipliers(at(z)));
}

TEST_F(PlateOnSpring, AugmentationDrivesThePenetrationBelowItsTolerance) {
  auto term = augmented(1e-6);
  equilibrate(term);
  double before = -z;
  int updates = 0;
  while (term.update_multipliers(at(z))) {
    ++updates;
    equilibrate(term);
    EXPECT_NEAR(-z / before, k / (k + penalty * A), 1e-6);
    before = -z;
  }
  EXPECT_GT(updates, 3);
  EXPECT_EQ(term.augmentation().updates, updates);
  EXPECT_FALSE(term.augmentation().gave_up);
  EXPECT_LE(term.augmentation().violation, 1e-6);
  for (const ContactNode& n : not_empty(term.nodes(at(z)))) EXPECT_NEAR(n.pressure, k * -w / A, 1e-4);
  // the multipliers outlive a committed increment, not one that is cut
  term.commit(at(z));
  const double kept = term.memory().pressure[0];
  EXPECT_GT(kept, .4);
  w = -.1;
  term.set_progress(.5);
  equilibrate(term);
  ASSERT_TRUE(term.update_multipliers(at(z)));
  const double pushed = term.figures(at(z)).on_master[0].force[2];
  term.roll_back();
  EXPECT_EQ(term.memory().pressure[0], kept);
  EXPECT_GT(term.figures(at(z)).on_master[0].force[2], pushed + .1);
}

TEST_F(PlateOnSpring, AugmentationGivesUpInTheEnd) {
  auto term = augmented(1e-12);
  k = 2000;
  int updates = 0;
  for (equilibrate(term); term.update_multipliers(at(z)); equilibrate(term)) ++updates;
  EXPECT_EQ(updates, 20);
  EXPECT_TRUE(term.augmentation().gave_up);
  EXPECT_GT(term.augmentation().violation, 1e-12);
}

TEST_F(PlateOnSpring, AugmentationLeavesNoGapWhereTheLoadWanes) {
  auto term = augmented(1e-6);
  for (equilibrate(term); term.update_multipliers(at(z)); equilibrate(term)) {
  }
  term.commit(at(z));
  w = -.02;
  term.set_progress(.5);
  equilibrate(term);
  EXPECT_GT(z, 1e-3) << "the old multiplier presses across a gap";
  while (term.update_multipliers(at(z))) equilibrate(term);
  EXPECT_LE(std::abs(z), 1e-6);
  EXPECT_GT(term.figures(at(z)).pairs, 0);
}

TEST_F(PlateOnSpring, AugmentedPlateIsReleasedWhenItLifts) {
  auto term = augmented(1e-6);
  equilibrate(term);
  while (term.update_multipliers(at(z))) equilibrate(term);
  term.commit(at(z));
  w = .1;
  term.set_progress(.5);
  for (equilibrate(term); term.update_multipliers(at(z)); equilibrate(term)) {
  }
  EXPECT_NEAR(z, w, 1e-10);
}

}  // namespace
}  // namespace bulbus
