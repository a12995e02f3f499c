#include "core/solve/step_lengths.hpp"

#include <gtest/gtest.h>

namespace bulbus {
namespace {

StepLengths after(const std::vector<double>& parts, double volume) {
  StepLengths lengths;
  for (double part : parts) lengths.add(part, {.volume = volume});
  return lengths;
}

TEST(StepLengths, OfWhichLittleIsLeftAtFirstEndAnIncrement) {
  EXPECT_FALSE(after({0.5, 1, 1, 0.5}, 0.1).exhausted());
  EXPECT_TRUE(after({0.5, 0.5, 1, 0.5}, 0.1).too_long());
  EXPECT_TRUE(after({0.5, 0.5, 0.5, 0.5}, 0.1).too_long());
  EXPECT_TRUE(after({0.125}, 0.1).exhausted());
  EXPECT_TRUE(after({0.0625}, 0.1).exhausted());
}

TEST(StepLengths, MayBeShortLaterFromStatesThatKeepTheirVolume) {
  EXPECT_FALSE(after({1, 1, 1, 1, 0.0625, 0.0625}, 0.1).exhausted());
  EXPECT_TRUE(after({1, 1, 1, 1, 0.0625}, 2.1).too_long());
  EXPECT_FALSE(after({1, 1, 1, 1, 0.5, 0.5}, 2.1).exhausted());
}

TEST(StepLengths, AreNotShortenedEightTimes) {
  const StepLengths lengths = after({1, 1, 1, 1, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5}, 0.1);
  EXPECT_TRUE(lengths.exhausted());
  EXPECT_FALSE(lengths.too_long());
}

TEST(StepLengths, OfZeroEndAnIncrement) { EXPECT_TRUE(after({1, 1, 1, 1, 0}, 0.1).exhausted()); }

}  // namespace
}  // namespace bulbus
