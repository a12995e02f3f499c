#include "contact/contact_term.hpp"

#include <gtest/gtest.h>

#include "core/element/block_csr.hpp"
#include "tests/support/sheets.hpp"

namespace bulbus {
namespace {

/// A slave sheet looking down on a master sheet looking up; their nodes do not match. Both are bent; the slave is `sunk` into it.
struct TwoSheets {
  Sheets sheets;
  std::vector<Quad> slave, master;
  double area = .8 * .8;

  explicit TwoSheets(double sunk, double bend = .05) {
    const auto height = [=](double x, double y) { return bend * (std::sin(3 * x) + x * y); };
    slave = sheets.add(5, 4, [=](double u, double v) { return Vec3<double>{.1 + .8 * v, .1 + .8 * u, height(.1 + .8 * v, .1 + .8 * u) - sunk}; });
    master = sheets.add(7, 6, [=](double u, double v) { return Vec3<double>{u, v, height(u, v)}; });
  }
  int slaves() const { return 30; }
  ContactTerm term(const ContactSpec& spec, int owned = -1) const {
    return ContactTerm(spec, {.penalty = 0, .depth = 0, .reach = .3},
                       {sheets.X, owned < 0 ? sheets.nodes() : owned, slave, Master(split(master)), {}}, Comm());
  }
};

std::vector<double> force(const ContactTerm& term, const State& state) {
  std::vector<double> f(state.x.size());
  term.add_residual(state, f, {});
  return f;
}

std::vector<double> action(const ContactTerm& term, std::span<const double> d) {
  std::vector<double> f(d.size());
  term.add_action(d, f);
  return f;
}

/// As after a Newton step that found the pressures of this state.
void settle(ContactTerm& term, const State& state) {
  term.linearize(state);
  term.predict(std::vector<double>(state.x.size()));
  term.linearize(state);
}

/// On a state that stays clear of edges where the selection changes.
struct ContactTermTest : testing::Test {
  TwoSheets two{.02};
  ContactTerm term = two.term(contact_spec(50, .1));
  State state = two.sheets.state();
  std::vector<double> d = noise_vector(state.x.size(), 4);
  ContactTermTest() {
    for (std::size_t i = 0; i < state.x.size(); ++i) state.x[i] += .004 * noise(9, i);
  }
};

TEST_F(ContactTermTest, HasActivePairs) {
  const ContactFigures f = term.figures(state);
  EXPECT_EQ(f.pairs, two.slaves());
  EXPECT_GT(f.penetration, .02);
  EXPECT_NEAR(f.area, two.area, .06 * two.area);
}

// On a bent master the force of interpolated normals has no potential.
TEST(Contact, ForceIsTheGradientOfThePotentialOnAFlatMaster) {
  const TwoSheets two(.02, 0);
  const auto term = two.term(contact_spec(50, .1));
  State state = two.sheets.state();
  for (int i = 0; i < 3 * two.slaves(); ++i) state.x[i] += .004 * noise(9, i);
  const auto d = noise_vector(state.x.size(), 4);
  const auto potential = [&](std::span<const double> x) { return std::vector{term.potential({{x.begin(), x.end()}, {}, {}, {}})}; };
  EXPECT_LT(std::abs(inner(force(term, state), d) / derivative(potential, state.x, d, 1e-5)[0] - 1), 1e-7);
}

TEST_F(ContactTermTest, ActionIsTheDerivativeOfTheForceOnceSettled) {
  term.linearize(state);
  const auto first = action(term, d);
  settle(term, state);
  const auto second = action(term, d);
  const auto exact = derivative([&](std::span<const double> x) { return force(term, {{x.begin(), x.end()}, {}, {}, {}}); }, state.x, d, 1e-5);
  EXPECT_LT(relative_difference(second, exact), 1e-7);
  EXPECT_GT(relative_difference(first, exact), 1e-3) << "the turning of the normal waits for settled pressures";
  EXPECT_GT(inner(first, d), 0);
}

TEST_F(ContactTermTest, ActionIsTheDerivativeOfTheForceWithMultipliersToo) {
  auto augmented = two.term(contact_spec(50, .1, 1e-4));
  ASSERT_TRUE(augmented.revise(state));
  EXPECT_GT(relative_difference(force(augmented, state), force(term, state)), .5);
  settle(augmented, state);
  const auto exact = derivative([&](std::span<const double> x) { return force(augmented, {{x.begin(), x.end()}, {}, {}, {}}); }, state.x, d, 1e-5);
  EXPECT_LT(relative_difference(action(augmented, d), exact), 1e-7);
}

TEST_F(ContactTermTest, NewIncrementsBeginWithTheRobustTangent) {
  term.linearize(state);
  const auto first = action(term, d);
  settle(term, state);
  EXPECT_NE(action(term, d), first);
  term.roll_back();
  term.linearize(state);
  EXPECT_EQ(action(term, d), first);
  settle(term, state);
  term.set_progress(.5);
  term.linearize(state);
  EXPECT_EQ(action(term, d), first);
}

TEST_F(ContactTermTest, PairsThatHaveJustClosedBeginWithTheRobustTangent) {
  term.linearize(state);
  const auto first = action(term, d);
  State open = state;
  for (int n = 0; n < two.slaves(); ++n) open.x[3 * n + 2] += .05;
  settle(term, open);
  term.linearize(state);
  EXPECT_EQ(action(term, d), first);
}

TEST_F(ContactTermTest, PressuresThatAreNotThePredictedOnesKeepTheRobustTangent) {
  term.linearize(state);
  const auto first = action(term, d);
  std::vector<double> up(state.x.size());
  for (int n = 0; n < two.slaves(); ++n) up[3 * n + 2] = .019;  // of a depth of .02 or so
  term.predict(up);
  term.linearize(state);
  EXPECT_EQ(action(term, d), first);
}

TEST_F(ContactTermTest, VisitedMatricesActAsTheTangent) {
  settle(term, state);
  const BlockCsr A(two.sheets.nodes(), [&](const ContributionVisitor& v) { term.visit(v); });
  std::vector<double> f(d.size());
  A.apply(d, f);
  EXPECT_LT(relative_difference(f, action(term, d)), 1e-13);
}

TEST_F(ContactTermTest, IsSymmetricUntilSettledOnly) {
  const auto e = noise_vector(d.size(), 5);
  term.linearize(state);
  EXPECT_NEAR(inner(e, action(term, d)), inner(d, action(term, e)), 1e-12);
  settle(term, state);
  EXPECT_GT(std::abs(inner(e, action(term, d)) - inner(d, action(term, e))), 1e-3);
  EXPECT_FALSE(term.symmetric());
}

TEST_F(ContactTermTest, PushesTheSlaveUpAndTheMasterDownInBalance) {
  const auto f = force(term, state);
  Vec3<double> slave{0, 0, 0}, all{0, 0, 0}, moment{0, 0, 0};
  for (int n = 0; n < two.sheets.nodes(); ++n) {
    const Vec3<double> at_node{f[3 * n], f[3 * n + 1], f[3 * n + 2]}, m = cross(at(state.x, n), at_node);
    for (int c = 0; c < 3; ++c) all[c] += at_node[c], moment[c] += m[c], slave[c] += n < two.slaves() ? at_node[c] : 0;
  }
  EXPECT_LT(slave[2], -.1) << "the residual is internal minus external";
  EXPECT_LT(norm(all), 1e-14 * norm(slave) * f.size());
  EXPECT_LT(norm(moment), 1e-14 * norm(slave) * f.size());
  const Wrench w = term.figures(state).on_master[0];
  EXPECT_LT(norm(minus(w.force, slave)), 1e-13);
  const Vec3<double> p{.3, .2, .1};
  EXPECT_NEAR(moment_about(p, w)[0], w.moment[0] - (p[1] * w.force[2] - p[2] * w.force[1]), 1e-14);
}

TEST_F(ContactTermTest, MagnitudeSumsTheContributions) {
  std::vector<double> f(state.x.size()), magnitude(two.sheets.nodes());
  term.add_residual(state, f, magnitude);
  double slave = 0, master = 0;
  for (int n = 0; n < two.sheets.nodes(); ++n) {
    EXPECT_GE(magnitude[n] * (1 + 1e-12), norm({f[3 * n], f[3 * n + 1], f[3 * n + 2]}));
    (n < two.slaves() ? slave : master) += magnitude[n];
  }
  EXPECT_NEAR(slave, master, 1e-12);
}

TEST_F(ContactTermTest, AddsToWhatIsThere) {
  auto f = noise_vector(state.x.size(), 1);
  const auto before = f;
  term.add_residual(state, f, {});
  EXPECT_LT(relative_difference(plus(f, -1, before), force(term, state)), 1e-12);
}

// Local numbers and the order of the nodes differ, the pairs do not.
TEST_F(ContactTermTest, RanksMakeTheSamePairs) {
  const auto whole = force(term, state);
  std::vector<double> sum(whole.size());
  for (int rank = 0; rank < 2; ++rank) {
    // this rank owns every other slave node; its local order begins with them
    std::vector<int> order;
    for (int n = 0; n < two.sheets.nodes(); ++n)
      if (n < two.slaves() && n % 2 == rank) order.push_back(n);
    const int owned = static_cast<int>(order.size());
    for (int n = two.sheets.nodes() - 1; n >= 0; --n)
      if (!(n < two.slaves() && n % 2 == rank)) order.push_back(n);
    std::vector<int> local(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) local[order[i]] = static_cast<int>(i);
    TwoSheets mine = two;
    State there = state;
    for (std::size_t i = 0; i < order.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        mine.sheets.X[3 * i + c] = two.sheets.X[3 * order[i] + c];
        there.x[3 * i + c] = state.x[3 * order[i] + c];
      }
    for (auto* faces : {&mine.slave, &mine.master})
      for (Quad& q : *faces)
        for (int& n : q) n = local[n];
    const auto part = mine.term(contact_spec(50, .1), owned);
    EXPECT_EQ(part.slave().nodes().size(), 15u);
    const auto f = force(part, there);
    for (std::size_t i = 0; i < order.size(); ++i)
      for (int c = 0; c < 3; ++c) sum[3 * order[i] + c] += f[3 * i + c];
  }
  EXPECT_LT(relative_difference(sum, whole), 1e-14);
}

TEST(Contact, CarriesAUniformPressureAcrossMeshesThatDoNotMatch) {
  const TwoSheets two(.01, 0);
  const auto term = two.term(contact_spec(50, .1));
  const State state = two.sheets.state();
  const ContactFigures f = term.figures(state);
  EXPECT_NEAR(f.on_master[0].force[2], -50 * .01 * two.area, 1e-14);
  EXPECT_NEAR(moment_about({.5, .5, 3}, f.on_master[0])[0], 0, 1e-14);
  EXPECT_NEAR(moment_about({.5, .5, 3}, f.on_master[0])[1], 0, 1e-14);
  EXPECT_NEAR(f.area, two.area, 1e-14);
  for (const ContactNode& n : term.nodes(state)) {
    EXPECT_NEAR(n.pressure, .5, 1e-13);
    EXPECT_NEAR(n.gap, -.01, 1e-15);
    EXPECT_TRUE(n.active);
  }
}

TEST(Contact, SlidesAcrossFlatFacesWithoutAJump) {
  const TwoSheets two(.01, 0);
  const auto term = two.term(contact_spec(50, .1));
  State state = two.sheets.state();
  const double step = 2e-4;
  auto before = force(term, state);
  const double all = norm(term.figures(state).on_master[0].force), most = largest(before);
  for (int k = 0; k < 300; ++k) {
    for (int n = 0; n < two.slaves(); ++n) state.x[3 * n] += step, state.x[3 * n + 1] += .7 * step;
    const auto now = force(term, state);
    EXPECT_LT(largest(plus(now, -1, before)), 30 * step * most) << k;
    EXPECT_NEAR(norm(term.figures(state).on_master[0].force), all, 1e-13);
    before = now;
  }
}

// The master rises from the plane; without the mirrored faces its normals there would have a component across the plane.
TEST(Contact, PushesNodesInASymmetryPlaneAlongIt) {
  Sheets s;
  const auto height = [](double x) { return x + x * x; };
  const auto slave = s.add(5, 4, [&](double u, double v) { return Vec3<double>{.8 * v, .1 + .8 * u, height(.8 * v) - .02}; });
  const auto master = s.add(7, 6, [&](double u, double v) { return Vec3<double>{u, v, height(u)}; });
  const auto across = [&](const std::vector<std::string>& planes) {
    const ContactTerm term(contact_spec(50, .1), {.penalty = 0, .depth = 0, .reach = .3},
                           {s.X, s.nodes(), slave, Master(split(master)), planes}, Comm());
    EXPECT_EQ(term.figures(s.state()).pairs, 30);
    double most = 0;
    for (const ContactNode& n : term.nodes(s.state()))
      if (s.X[3 * n.node] == 0) most = std::max(most, std::abs(n.force[0]) / norm(n.force));
    return most;
  };
  EXPECT_LT(across({"x"}), 1e-30);
  EXPECT_GT(across({}), .5);
}

TEST(Contact, OpensAgain) {
  const TwoSheets two(.01);
  auto term = two.term(contact_spec(50, .1));
  State state = two.sheets.state();
  EXPECT_GT(largest(force(term, state)), 0);
  term.commit(state);
  for (int n = 0; n < two.slaves(); ++n) state.x[3 * n + 2] += .05;
  EXPECT_EQ(largest(force(term, state)), 0);
  EXPECT_EQ(term.figures(state).pairs, 0);
  term.linearize(state);
  EXPECT_EQ(largest(action(term, state.x)), 0);
  for (const ContactNode& n : term.nodes(state)) {
    EXPECT_NEAR(n.gap, .04, .003);
    EXPECT_FALSE(n.active);
    EXPECT_EQ(n.pressure, 0);
  }
  for (int n = 0; n < two.slaves(); ++n) state.x[3 * n + 2] += 5;
  for (const ContactNode& n : term.nodes(state)) EXPECT_EQ(n.gap, .3) << "the reach";
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

// What was far a moment ago is not looked at; that must never show. A term that has seen nothing but the last converged state judges.
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

TEST(Contact, MakesNoPairsOfNodesThatBothSurfacesShare) {
  TwoSheets two(.01);
  two.slave.push_back({29, 28, two.master[0][0], two.master[0][1]});
  EXPECT_EQ(two.term(contact_spec(50, .1)).slave().nodes().size(), 30u);
}

/// A pair pressed .001 deep, and the state where the curved way of its node has opened it by .0005.
struct ActiveSet : testing::Test {
  TwoSheets two{.001, 0};
  ContactTerm term = two.term(contact_spec(50, .1));
  State closed = two.sheets.state(), open = closed;
  std::vector<double> dx = std::vector<double>(closed.x.size());
  static constexpr int node = 7, z = 3 * node + 2;
  ActiveSet() { open.x[z] += .0015; }
};

TEST_F(ActiveSet, APairOfPredictedPressurePullsBackUntilTheIncrementEnds) {
  EXPECT_EQ(force(term, open)[z], 0) << "the law";
  term.linearize(closed);
  term.predict(dx);
  const auto pulled = force(term, open);
  EXPECT_GT(pulled[z], 0);
  EXPECT_NEAR(pulled[z] / force(term, closed)[z], -.5, .01);
  term.linearize(open);
  dx[z] = 1;
  EXPECT_GT(action(term, dx)[z], 0) << "it keeps its stiffness";
  ASSERT_TRUE(term.revise(open)) << "no tension at the end of an increment";
  EXPECT_EQ(force(term, open)[z], 0);
  term.linearize(open);
  EXPECT_FALSE(term.revise(open));
}

TEST_F(ActiveSet, APairThatIsReleasedAgainAndAgainFollowsTheLawForTheRestOfTheIncrement) {
  for (int k = 0; k < 3; ++k) {
    term.linearize(closed);
    term.predict(dx);
    ASSERT_TRUE(term.revise(open));
  }
  term.linearize(closed);
  term.predict(dx);
  EXPECT_EQ(force(term, open)[z], 0);
  term.set_progress(.5);
  term.linearize(closed);
  term.predict(dx);
  EXPECT_GT(force(term, open)[z], 0);
}

TEST_F(ActiveSet, OneThatTheLastSolutionWasNotFoundWithIsTriedOnce) {
  EXPECT_FALSE(term.revise(open)) << "nothing was solved";
  term.linearize(closed);
  EXPECT_TRUE(term.revise(open));
  EXPECT_FALSE(term.revise(open));
  term.set_progress(.5);
  term.linearize(closed);
  EXPECT_FALSE(term.revise(closed));
}

TEST_F(ActiveSet, APairOfPredictedTensionOpens) {
  dx[z] = .0012;
  term.linearize(closed);
  term.predict(dx);
  EXPECT_EQ(force(term, open)[z], 0);
}

TEST_F(ActiveSet, TheMasterCountsInThePrediction) {
  for (int n = two.slaves(); n < two.sheets.nodes(); ++n) dx[3 * n + 2] = -.0012;
  term.linearize(closed);
  term.predict(dx);
  EXPECT_EQ(force(term, open)[z], 0);
}

TEST_F(ActiveSet, NothingIsPredictedAcrossIncrements) {
  for (const auto& next : {std::function([&] { term.roll_back(); }), std::function([&] { term.set_progress(.5); })}) {
    term.linearize(closed);
    term.predict(dx);
    ASSERT_GT(force(term, open)[z], 0);
    next();
    EXPECT_EQ(force(term, open)[z], 0);
  }
}

// A master that is a ridge of two faces: the side force of a node that crosses it goes through zero.
TEST(Contact, ForceGoesOnAcrossARidge) {
  Sheets s;
  const auto slave = s.add(1, 1, [](double u, double v) { return Vec3<double>{.04 * v - .02, u - .5, .92}; });
  const auto master = s.add(1, 2, [](double u, double v) { return Vec3<double>{-(2 * v - 1), 2 * u - 1, 1 - .3 * std::abs(2 * v - 1)}; });
  const ContactTerm term(contact_spec(50, .1), {.penalty = 0, .depth = 0, .reach = .3}, {s.X, s.nodes(), slave, Master(split(master)), {}}, Comm());
  State state = s.state();
  for (int n = 0; n < 4; ++n) state.x[3 * n] -= .15;
  double before = force(term, state)[0];
  EXPECT_GT(before, 0);
  const double step = 1e-3, slope = 2 * before / .15;
  for (int k = 0; k < 300; ++k) {
    for (int n = 0; n < 4; ++n) state.x[3 * n] += step;
    const double now = force(term, state)[0];
    EXPECT_NEAR(now, before, 5 * slope * step) << k;
    before = now;
  }
  EXPECT_LT(before, 0);
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

// Rehearsals are part of every check.
TEST(Contact, LooksForPairsOnlyInStepsThatAreSolved) {
  const TwoSheets two(-.01);
  auto term = two.term(contact_spec(50, .1));
  State state = two.sheets.state(), deep = state;
  for (int n = 0; n < two.slaves(); ++n) deep.x[3 * n + 2] -= .2;
  for (int step = 0; step < 3; ++step) term.pass_step(step, state);
  EXPECT_EQ(term.searches(), 0);
  term.begin_step(3, state);
  EXPECT_EQ(term.searches(), 1);
  EXPECT_EQ(term.figures(deep).pairs, two.slaves()) << "seen in front before";
}

}  // namespace
}  // namespace bulbus
