// Contacts that open, that are driven deep, and that overlap at the start.
#include <gtest/gtest.h>

#include "tests/support/not_empty.hpp"
#include "tests/unit/contact/two_sheets.hpp"

namespace bulbus {
namespace {

TEST(Contact, OpensAgain) {
  const TwoSheets two(.01);
  auto term = two.term(contact_spec(50, .1));
  State state = two.sheets.state();
  EXPECT_GT(largest(force(term, state)), 0);
  term.commit(state);
  for (int n = 0; n < two.slaves(); ++n) state.x[3 * n + 2] += .05;
  EXPECT_EQ(largest(force(term, state)), 0);
  EXPECT_EQ(term.figures(state).pairs, 0);
  EXPECT_EQ(largest(action(term, state, state.x)), 0);
  for (const ContactNode& n : not_empty(term.nodes(state))) {
    EXPECT_NEAR(n.gap, .04, .003);
    EXPECT_FALSE(n.active);
    EXPECT_EQ(n.pressure, 0);
  }
  for (int n = 0; n < two.slaves(); ++n) state.x[3 * n + 2] += 5;
  for (const ContactNode& n : not_empty(term.nodes(state))) EXPECT_EQ(n.gap, INFINITY) << "beyond the reach";
}

TEST(Contact, KeepsNodesThatAnIncrementDrivesDeeperThanAllowed) {
  const TwoSheets two(-.01);
  auto term = two.term(contact_spec(50, .1));
  State state = two.sheets.state(), deep = state;
  for (int n = 0; n < two.slaves(); ++n) deep.x[3 * n + 2] -= .2;
  EXPECT_EQ(term.figures(deep).pairs, 0) << "taken for another side";
  term.begin_step(0, state);
  EXPECT_EQ(term.figures(deep).pairs, two.slaves()) << "seen in front before";
}

// What was far a moment ago is not looked at; that must never show. A term that has seen nothing but the last
// converged state judges.
TEST(Contact, SparesPointsThatCannotTouchOnly) {
  const TwoSheets two(-.2);
  auto spec = contact_spec(50, .1);
  auto term = two.term(spec);
  const State start = two.sheets.state();
  State state = start;
  term.begin_step(0, state);
  int touched = 0;
  for (int move = 0; move < 200; ++move) {
    state = start;
    const double down = .4 * std::abs(noise(1, move)), tilt = .3 * noise(2, move);
    for (int n = 0; n < two.slaves(); ++n) state.x[3 * n + 2] -= down + tilt * (state.x[3 * n] - .5);
    auto fresh = two.term(spec);
    fresh.begin_step(0, start);
    ASSERT_EQ(force(term, state), force(fresh, state)) << move;
    touched += term.figures(state).pairs > 0;
  }
  EXPECT_GT(touched, 30);
  EXPECT_LT(touched, 170);
}

TEST(Contact, IsQuietAboutStatesThatAreNotFinite) {
  const TwoSheets two(.01);
  auto term = two.term(contact_spec(50, .1));
  State state = two.sheets.state();
  state.x[4] = NAN;
  EXPECT_EQ(largest(force(term, state)), 0);
}

TEST(Contact, ReportsAnOverlapAtTheStart) {
  const TwoSheets two(.15);
  const auto term = two.term(contact_spec(50, .1));
  State state = two.sheets.state();
  state.x[3 * 11 + 2] -= .02;
  const Overlap o = term.overlaps(state, 1e-3);
  EXPECT_EQ(o.points, two.slaves());
  EXPECT_EQ(o.place, at(state.x, 11));
  EXPECT_NEAR(o.depth, .17, .01);
  EXPECT_EQ(two.term(contact_spec(50, .1)).overlaps(TwoSheets(-.01).sheets.state(), 1e-3).points, 0);
}

TEST(Contact, ResolvesAnOverlapOverTheFirstStep) {
  const TwoSheets two(.15, 0);
  auto term = two.term(contact_spec(50, .1));
  const State state = two.sheets.state();
  term.resolve(state);
  term.begin_step(0, state);
  const auto pressure = [&] { return term.nodes(state)[12].pressure; };
  EXPECT_EQ(pressure(), 0);
  EXPECT_EQ(term.figures(state).penetration, 0);
  term.set_progress(.5);
  EXPECT_NEAR(pressure(), 50 * .075, 1e-12);
  term.commit(state);
  term.set_progress(1);
  EXPECT_NEAR(pressure(), 50 * .15, 1e-12);
  term.commit(state);
  EXPECT_FALSE(term.memory().overlap.empty());
  term.freeze();
  EXPECT_TRUE(term.memory().overlap.empty());
  term.begin_step(1, state);
  term.set_progress(.1);
  EXPECT_NEAR(pressure(), 50 * .15, 1e-12);
}

}  // namespace
}  // namespace bulbus
