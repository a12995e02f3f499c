#include "core/problem/formula.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"

namespace bulbus {
namespace {

bool holds(const std::string& text, const Vec3<double>& X) { return Formula(text, "mesh.sets.a").holds(X); }

std::string refusal(const std::string& text) {
  try {
    const Formula formula(text, "mesh.sets.a");
    formula.require_timeless();
    formula.holds({1, 2, 3});
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Formula, Compares) {
  EXPECT_TRUE(holds("X < 0.1", {0, 5, 5}));
  EXPECT_FALSE(holds("X < 0.1", {.1, 5, 5}));
  EXPECT_TRUE(holds("X*X + Y*Y <= 25 && Z > 0", {3, 4, 1}));
  EXPECT_FALSE(holds("X*X + Y*Y <= 25 && Z > 0", {3, 4, 0}));
  EXPECT_TRUE(holds("X == 3 || Y != 4", {3, 4, 0}));
  EXPECT_TRUE(holds("abs(Z - 1) >= 2", {0, 0, -1}));
  EXPECT_TRUE(holds("1", {0, 0, 0}));
}

TEST(Formula, WhatIsNoConditionIsRefused) {
  EXPECT_NE(refusal("X - 0.25").find("'X - 0.25' is no condition: at X = 1, Y = 2, Z = 3 it is 0.75"),
            std::string::npos);
  EXPECT_NE(refusal("X < s").find("depends on s, but a mesh has no steps"), std::string::npos);
  EXPECT_NE(refusal("X <").find("cannot read the formula"), std::string::npos);
  EXPECT_NE(refusal("R < 1").find("cannot read the formula"), std::string::npos);
  EXPECT_EQ(refusal("X < 1"), "");
}

TEST(Formula, ComparisonsOfComparisonsAreRefused) {
  for (const char* chain : {"0.1 < X < 0.9", "X == Y == Z", "Z > 0 && (0 <= X <= 1)", "0 < abs(X) < 2"})
    EXPECT_NE(refusal(chain).find("compares the outcome of a comparison"), std::string::npos) << chain;
  for (const char* joined : {"0.1 < X && X < 9", "X < 2 || Y < 1 || Z != 3", "(X < 2) && (Y <= 2)",
                             "X > 1 ? Y < 2 : Z > 2", "max(X > 2, Y > 1) == 1"})
    EXPECT_EQ(refusal(joined), "") << joined;
}

// To the parser `=` sets a variable, and has its value.
TEST(Formula, SingleEqualsSignsAreRefused) {
  for (const char* one : {"X = 1", "Z = 5 && Y > 0", "(Z=3)", "X < 2 ? Y = 1 : 0"})
    EXPECT_NE(refusal(one).find("a single '='"), std::string::npos) << one;
  for (const char* two : {"X == 1", "Y <= 2", "Z >= 3", "X != 5"}) EXPECT_EQ(refusal(two), "") << two;
}

// Comparisons are false of them, min and max may pass over them, and 1/(1/0) is 0.
TEST(Formula, PartsWithoutAValueAreRefused) {
  for (const char* hidden :
       {"max(0.1, sqrt(-1))", "0.1*(sqrt(-1)<1)", "0.1/(1/0)", "sqrt(-1) > 0 ? 0.1 : 0.2", "0.1*(log(0)<0)",
        "max(X, sqrt(Y - 3))", "1/(1/(Z - 3)) + X", "(X - 1)/(X - 1) > 0"}) {
    try {
      Formula(hidden, "steps.0.displace.0.x")({1, 2, 3}, 1, 1);
      ADD_FAILURE() << hidden;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("part of"), std::string::npos) << hidden << ": " << e.what();
    }
  }
  for (const char* sound :
       {"X > 1 ? sqrt(X - 2) : 0.1", "1/(1 + exp(1000*X))", "1/X", "sqrt(Z)*log(Y)", "atan2(X, 0)"})
    EXPECT_NO_THROW(Formula(sound, "steps.0.displace.0.x")({1, 2, 3}, 1, 1)) << sound;
}

}  // namespace
}  // namespace bulbus
