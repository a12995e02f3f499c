#include "contact/law/contact_term.hpp"

#include <gtest/gtest.h>

#include "core/element/block_csr.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/unit/contact/two_sheets.hpp"

namespace bulbus {
namespace {

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
  const auto potential = [&](std::span<const double> x) {
    return std::vector{term.potential({{x.begin(), x.end()}, {}, {}, {}})};
  };
  EXPECT_LT(std::abs(inner(force(term, state), d) / derivative(potential, state.x, d, 1e-5)[0] - 1), 1e-7);
}

TEST_F(ContactTermTest, ActionIsTheDerivativeOfTheForceOnceSettled) {
  const auto first = action(term, state, d);
  settle(term, state);
  const auto second = action(term, state, d);
  const auto exact = derivative(
      [&](std::span<const double> x) {
        return force(term, {{x.begin(), x.end()}, {}, {}, {}});
      },
      state.x, d, 1e-5);
  EXPECT_LT(relative_difference(second, exact), 1e-7);
  EXPECT_GT(relative_difference(first, exact), 1e-3)
      << "the turning of the normal waits for settled pressures";
  EXPECT_GT(inner(first, d), 0);
}

TEST_F(ContactTermTest, ActionIsTheDerivativeOfTheForceWithMultipliersToo) {
  auto augmented = two.term(contact_spec(50, .1, 1e-4));
  ASSERT_TRUE(augmented.update_multipliers(state));
  EXPECT_GT(relative_difference(force(augmented, state), force(term, state)), .5);
  settle(augmented, state);
  const auto found = action(augmented, state, d);
  const auto exact = derivative(
      [&](std::span<const double> x) {
        return force(augmented, {{x.begin(), x.end()}, {}, {}, {}});
      },
      state.x, d, 1e-5);
  EXPECT_LT(relative_difference(found, exact), 1e-7);
}

TEST_F(ContactTermTest, TangentStaysWhatItIsWhateverBecomesOfTheTerm) {
  const auto tangent = tangent_at(term, state);
  const auto first = action(*tangent, d);
  settle(term, state);
  State open = state;
  for (int n = 0; n < two.slaves(); ++n) open.x[3 * n + 2] += .05;
  term.commit(open);
  EXPECT_EQ(action(*tangent, d), first);
  EXPECT_NE(action(term, open, d), first);
}

TEST_F(ContactTermTest, NewIncrementsBeginWithTheRobustTangent) {
  const auto first = action(term, state, d);
  settle(term, state);
  EXPECT_NE(action(term, state, d), first);
  term.roll_back();
  EXPECT_EQ(action(term, state, d), first);
  settle(term, state);
  term.set_progress(.5);
  EXPECT_EQ(action(term, state, d), first);
}

TEST_F(ContactTermTest, PairsThatHaveJustClosedBeginWithTheRobustTangent) {
  const auto first = action(term, state, d);
  State open = state;
  for (int n = 0; n < two.slaves(); ++n) open.x[3 * n + 2] += .05;
  settle(term, open);
  EXPECT_EQ(action(term, state, d), first);
}

TEST_F(ContactTermTest, PressuresThatAreNotThePredictedOnesKeepTheRobustTangent) {
  const auto first = action(term, state, d);
  std::vector<double> up(state.x.size());
  for (int n = 0; n < two.slaves(); ++n) up[3 * n + 2] = .019;  // of a depth of .02 or so
  step_from(state, up, term);
  EXPECT_EQ(action(term, state, d), first);
}

TEST_F(ContactTermTest, VisitedMatricesActAsTheTangent) {
  settle(term, state);
  const auto tangent = tangent_at(term, state);
  const BlockCsr A(two.sheets.nodes(), [&](const ContributionVisitor& v) { tangent->visit(v); });
  std::vector<double> f(d.size());
  A.apply(d, f);
  EXPECT_LT(relative_difference(f, action(term, state, d)), 1e-13);
}

TEST_F(ContactTermTest, IsSymmetricUntilSettledOnly) {
  const auto e = noise_vector(d.size(), 5);
  EXPECT_NEAR(inner(e, action(term, state, d)), inner(d, action(term, state, e)), 1e-12);
  settle(term, state);
  EXPECT_GT(std::abs(inner(e, action(term, state, d)) - inner(d, action(term, state, e))), 1e-3);
  EXPECT_FALSE(term.symmetric());
}

TEST_F(ContactTermTest, PushesTheSlaveUpAndTheMasterDownInBalance) {
  const auto f = force(term, state);
  Vec3<double> slave{0, 0, 0}, all{0, 0, 0}, moment{0, 0, 0};
  for (int n = 0; n < two.sheets.nodes(); ++n) {
    const Vec3<double> at_node = at(f, n), m = cross(at(state.x, n), at_node);
    for (int c = 0; c < 3; ++c)
      all[c] += at_node[c], moment[c] += m[c], slave[c] += n < two.slaves() ? at_node[c] : 0;
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
  std::vector<double> f(state.x.size()), reference_force(two.sheets.nodes());
  term.add_residual(state, f, reference_force);
  double slave = 0, master = 0;
  for (int n = 0; n < two.sheets.nodes(); ++n) {
    EXPECT_GE(reference_force[n] * (1 + 1e-12), norm(at(f, n)));
    (n < two.slaves() ? slave : master) += reference_force[n];
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
  for (const ContactNode& n : not_empty(term.nodes(state))) {
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

// The master rises from the plane; without the mirrored faces its normals there would have a component across
// the plane.
TEST(Contact, PushesNodesInASymmetryPlaneAlongIt) {
  Sheets s;
  const auto height = [](double x) { return x + x * x; };
  const auto slave = s.add(5, 4, [&](double u, double v) {
    return Vec3<double>{.8 * v, .1 + .8 * u, height(.8 * v) - .02};
  });
  const auto master = s.add(7, 6, [&](double u, double v) { return Vec3<double>{u, v, height(u)}; });
  const auto across = [&](const std::vector<std::string>& planes) {
    const ContactTerm term(contact_spec(50, .1), {.penalty = 0, .depth = 0, .reach = .3},
                           {s.X, s.nodes(), slave, Master(split(master)), planes}, Comm());
    EXPECT_EQ(term.figures(s.state()).pairs, 30);
    double most = 0;
    for (const ContactNode& n : term.nodes(s.state()))
      if (s.X[3 * n.node] == 0) most = worse(most, std::abs(n.force[0]) / norm(n.force));
    return most;
  };
  EXPECT_LT(across({"x"}), 1e-30);
  EXPECT_GT(across({}), .5);
}

TEST(Contact, MakesNoPairsOfNodesThatBothSurfacesShare) {
  TwoSheets two(.01);
  two.slave.push_back({29, 28, two.master[0][0], two.master[0][1]});
  EXPECT_EQ(two.term(contact_spec(50, .1)).slave().nodes().size(), 30u);
}

// A slave that reaches past a master of one face: of points past its rim the part φ counts that is pressed.
TEST(Contact, FiguresCountPointsPastARimInPart) {
  constexpr double sunk = .01, penalty = 50;
  for (int divisions : {0, 3}) {
    Sheets s;
    const auto slave = s.add(10, 10, [](double u, double v) {
      return Vec3<double>{2 * v - .5, 2 * u - .5, -sunk};
    });
    const auto master = s.add(1, 1, [](double u, double v) { return Vec3<double>{u, v, 0}; });
    ContactSpec spec = contact_spec(penalty, .1);
    spec.divisions = divisions;
    const ContactTerm term(spec, {.penalty = 0, .depth = 0, .reach = .3},
                           {s.X, s.nodes(), slave, Master(split(master)), {}}, Comm());
    const ContactFigures f = term.figures(s.state());
    const double pressed = -f.on_master[0].force[2] / (penalty * sunk);
    EXPECT_GT(pressed, 1);
    EXPECT_NEAR(f.area, pressed, divisions > 0 ? 1e-12 : .1 * pressed) << divisions;
  }
}

// Behind a master but beside its rim a point is not inside of anything.
TEST(Contact, PointsBesideARimAreNotInside) {
  for (const auto& [from, expected] : {std::pair{1.02, 0}, {.9, 9}}) {
    Sheets s;
    const auto slave = s.add(2, 2, [from](double u, double v) {
      return Vec3<double>{from + .08 * v, .4 + .2 * u, -.02};
    });
    const auto master = s.add(1, 1, [](double u, double v) { return Vec3<double>{u, v, 0}; });
    ContactTerm term(contact_spec(50, .1), {.penalty = 0, .depth = 0, .reach = .3},
                     {s.X, s.nodes(), slave, Master(split(master)), {}}, Comm());
    const State start = s.state();
    EXPECT_EQ(term.overlaps(start, 1e-4).points, expected);
    EXPECT_NEAR(term.penetration(start), expected > 0 ? .02 : 0, 1e-12);
    term.begin_step(0, start);
    EXPECT_EQ(term.figures(start).pairs, expected);
  }
}

// A master that is a ridge of two faces: the side force of a node that crosses it goes through zero.
TEST(Contact, ForceGoesOnAcrossARidge) {
  Sheets s;
  const auto slave = s.add(1, 1, [](double u, double v) { return Vec3<double>{.04 * v - .02, u - .5, .92}; });
  const auto master = s.add(1, 2, [](double u, double v) {
    return Vec3<double>{-(2 * v - 1), 2 * u - 1, 1 - .3 * std::abs(2 * v - 1)};
  });
  const ContactTerm term(contact_spec(50, .1), {.penalty = 0, .depth = 0, .reach = .3},
                         {s.X, s.nodes(), slave, Master(split(master)), {}}, Comm());
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
