#include "precond/reuse_policy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bulbus {
namespace {

constexpr Reuse nothing{};
constexpr Reuse everything{.displacement = true, .coarse_factors = true, .corrections = true};
constexpr Reuse factors{.coarse_factors = true};

SolveHistory solved(std::initializer_list<double> iterations_per_digit) {
  SolveHistory history;
  for (double n : iterations_per_digit) history.add(n);
  return history;
}

// By default: factors while their matrix hardly changes.
constexpr ReuseLimits tight{.slowdown = 0, .coarse_change = .1};
// Of the presets fast and balanced.
constexpr ReuseLimits loose{.slowdown = 2, .coarse_change = .1};

TEST(ReusePolicy, WithoutASolveThereIsNothingToReuse) {
  EXPECT_EQ(reusable(loose, {}, {}), nothing);
  EXPECT_EQ(reusable(tight, {}, {}), nothing);
}

TEST(ReusePolicy, HistoryCountsFromTheFirstSolve) {
  const SolveHistory history = solved({3, 1, 2});
  EXPECT_EQ(history.solves, 3);
  EXPECT_EQ(history.first, 3);
  EXPECT_EQ(history.last, 2);
}

TEST(ReusePolicy, KeepsAllAsLongAsSolvesAreNearlyAsFastAsTheFirst) {
  EXPECT_EQ(reusable(loose, solved({5, 10}), {}), everything);
  EXPECT_EQ(reusable(loose, solved({5, 10.1}), {}), nothing);
  EXPECT_EQ(reusable({.slowdown = 3, .coarse_change = .1}, solved({5, 10.1}), {}), everything);
}

TEST(ReusePolicy, NewStiffnessLeavesTheCoarseFactorsAtMost) {
  EXPECT_EQ(reusable(loose, solved({2, 2}), {.largest_eigenvalue = 1.29}), everything);
  EXPECT_EQ(reusable(loose, solved({2, 2}), {.largest_eigenvalue = 1.31}), factors);
  EXPECT_EQ(reusable(loose, solved({2, 2}), {.largest_eigenvalue = 1.31, .coarse_rows = .2}), nothing);
  EXPECT_EQ(reusable(loose, solved({2, 2}), {.largest_eigenvalue = NAN}), factors);
}

TEST(ReusePolicy, KeepsCoarseFactorsWhileSolvesAreEasy) {
  EXPECT_EQ(reusable(tight, solved({3, 4}), {}), factors);
  EXPECT_EQ(reusable(tight, solved({3, 4.1}), {}), nothing) << "hard in itself";
  EXPECT_EQ(reusable(tight, solved({1, 2}), {}), factors);
  EXPECT_EQ(reusable(tight, solved({1, 2.1}), {}), nothing) << "much slower than with factors of its own";
}

TEST(ReusePolicy, KeepsCoarseFactorsWhileTheirMatrixHardlyChanges) {
  EXPECT_EQ(reusable(tight, solved({1}), {.coarse_rows = .1}), factors);
  EXPECT_EQ(reusable(tight, solved({1}), {.coarse_rows = .11}), nothing);
  EXPECT_EQ(reusable(tight, solved({1}), {.coarse_rows = std::numeric_limits<double>::infinity()}), nothing);
  EXPECT_EQ(reusable(tight, solved({1}), {.coarse_rows = NAN}), nothing);
  EXPECT_EQ(reusable({.coarse_change = 0}, solved({1}), {}), nothing) << "switched off";
}

TEST(ReusePolicy, CorrectionsStayWithTheFactorsWhereTheyHaveTheirOwnLines) {
  ReuseLimits refined = tight;
  refined.corrections_own_lines = true;
  EXPECT_EQ(reusable(refined, solved({1}), {}), (Reuse{.coarse_factors = true, .corrections = true}));
  EXPECT_EQ(reusable(refined, solved({1}), {.coarse_rows = .2}), nothing);
}

// What is measured later never brings back what was given up before.
TEST(ReusePolicy, AllowsLessTheMoreHasChanged) {
  for (const ReuseLimits& limits : {tight, loose})
    for (double last : {1., 3., 9.})
      for (double eigenvalue : {1., 2.})
        for (double rows : {0., 1.}) {
          const Reuse before = reusable(limits, solved({2, last}), {}),
                      then = reusable(limits, solved({2, last}), {eigenvalue, rows});
          EXPECT_LE(then.displacement, before.displacement);
          EXPECT_LE(then.coarse_factors, before.coarse_factors);
          EXPECT_LE(then.corrections, before.corrections);
        }
}

}  // namespace
}  // namespace bulbus
