#include "core/solve/increments.hpp"

#include <gtest/gtest.h>

namespace bulbus {
namespace {

constexpr int few = 4, many = 12;

Increments whole(int count) { return {count, SteppingSettings{}, {}, 1}; }

TEST(Increments, EndWhereTheStepDoes) {
  const Increments thirds = whole(3);
  EXPECT_DOUBLE_EQ(thirds.next(0), 1 / 3.);
  EXPECT_EQ(thirds.next(2 / 3.), 1);
  EXPECT_EQ(thirds.next(.665), 1) << "what is left would be no increment";
}

TEST(Increments, GrowAfterFewIterations) {
  Increments i = whole(4);
  i.cut();
  i.succeeded(few);
  EXPECT_DOUBLE_EQ(i.pace().size, .125 * 1.5);
  i.succeeded(few), i.succeeded(few);
  EXPECT_EQ(i.pace().size, .25);
}

// Each of the short ones takes as many iterations as a whole one would.
TEST(Increments, AreTriedTwiceAsLongAfterTwo) {
  Increments i = whole(4);
  i.cut(), i.cut();
  EXPECT_EQ(i.pace().size, .0625);
  i.succeeded(many);
  EXPECT_EQ(i.pace().size, .0625);
  i.succeeded(many);
  EXPECT_EQ(i.pace().size, .125);
}

TEST(Increments, WaitTwiceAsLongWhereThatFails) {
  Increments i = whole(4);
  i.cut(), i.cut();
  for (int waits : {2, 4, 8}) {
    for (int k = 0; k < waits; ++k) {
      EXPECT_EQ(i.pace().size, .0625) << waits;
      i.succeeded(many);
    }
    EXPECT_EQ(i.pace().size, .125);
    i.cut();
  }
}

TEST(Increments, GoOnAsTheyWere) {
  Increments i = whole(4);
  i.cut();
  i.succeeded(many);
  Increments again(4, SteppingSettings{}, i.pace(), 1);
  for (Increments* one : {&i, &again}) {
    one->succeeded(many);
    EXPECT_EQ(one->pace().size, .25);
  }
}

TEST(Increments, EndAfterFourHalvings) {
  Increments i = whole(2000);
  for (int k = 0; k < 4; ++k) EXPECT_TRUE(i.cut());
  EXPECT_FALSE(i.cut());
}

}  // namespace
}  // namespace bulbus
