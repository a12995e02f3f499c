// Which pairs count between the iterations of Newton's method, and at the end of an increment.
#include <gtest/gtest.h>

#include "tests/unit/contact/two_sheets.hpp"

namespace bulbus {
namespace {

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
  step_from(closed, dx, term);
  const auto pulled = force(term, open);
  EXPECT_GT(pulled[z], 0);
  EXPECT_NEAR(pulled[z] / force(term, closed)[z], -.5, .01);
  std::vector<double> up(dx.size());
  up[z] = 1;
  EXPECT_GT(action(term, open, up)[z], 0) << "it keeps its stiffness";
  ASSERT_TRUE(term.update_multipliers(open)) << "no tension at the end of an increment";
  EXPECT_EQ(force(term, open)[z], 0);
  step_from(open, dx, term);
  EXPECT_FALSE(term.update_multipliers(open));
}

TEST_F(ActiveSet, APairThatHasOpenedFarPullsBackHoweverOftenItIsLookedAt) {
  ContactTerm term = two.term(contact_spec(50, .02));
  term.begin_step(0, closed);
  step_from(closed, dx, term);
  open.x[z] = closed.x[z] + .08;  // farther than the depth, where nothing matters that was not predicted
  State beside = open;
  beside.x[z] += 1e-6;
  const auto pulled = force(term, open);
  EXPECT_GT(pulled[z], 0);
  force(term, beside);
  EXPECT_EQ(force(term, open), pulled);
}

TEST_F(ActiveSet, APairThatIsReleasedAgainAndAgainFollowsTheLawForTheRestOfTheIncrement) {
  for (int k = 0; k < 3; ++k) {
    step_from(closed, dx, term);
    ASSERT_TRUE(term.update_multipliers(open));
  }
  step_from(closed, dx, term);
  EXPECT_EQ(force(term, open)[z], 0);
  term.set_progress(.5);
  step_from(closed, dx, term);
  EXPECT_GT(force(term, open)[z], 0);
}

TEST_F(ActiveSet, OneThatTheLastSolutionWasNotFoundWithIsTriedOnce) {
  EXPECT_FALSE(term.update_multipliers(open)) << "nothing was solved";
  dx[z] = .0012;  // predicts tension
  step_from(closed, dx, term);
  EXPECT_TRUE(term.update_multipliers(open));
  EXPECT_FALSE(term.update_multipliers(open));
  term.set_progress(.5);
  step_from(closed, std::vector<double>(dx.size()), term);
  EXPECT_FALSE(term.update_multipliers(closed));
}

TEST_F(ActiveSet, APairOfPredictedTensionOpens) {
  dx[z] = .0012;
  step_from(closed, dx, term);
  EXPECT_EQ(force(term, open)[z], 0);
}

TEST_F(ActiveSet, TheMasterCountsInThePrediction) {
  for (int n = two.slaves(); n < two.sheets.nodes(); ++n) dx[3 * n + 2] = -.0012;
  step_from(closed, dx, term);
  EXPECT_EQ(force(term, open)[z], 0);
}

TEST_F(ActiveSet, NothingIsPredictedAcrossIncrements) {
  for (const auto& next :
       {std::function([&] { term.roll_back(); }), std::function([&] { term.set_progress(.5); })}) {
    step_from(closed, dx, term);
    ASSERT_GT(force(term, open)[z], 0);
    next();
    EXPECT_EQ(force(term, open)[z], 0);
  }
}

}  // namespace
}  // namespace bulbus
