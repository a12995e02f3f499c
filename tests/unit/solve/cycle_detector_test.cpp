#include "core/solve/cycle_detector.hpp"

#include <gtest/gtest.h>

namespace bulbus {
namespace {

// Steps that may be taken while the equilibrium error goes to and fro `times` times between two states.
std::vector<double> steps_to_and_fro(CycleDetector& cycle, int times) {
  std::vector<double> steps;
  for (int i = 0; i < times; ++i)
    for (double force : {1e-2, 1e-3}) steps.push_back(cycle.longest_step({.force = force}));
  return steps;
}

TEST(CycleDetector, HalvesTheStepOfTheFirstCycleAndEndsTheSecond) {
  CycleDetector cycle;
  EXPECT_EQ(steps_to_and_fro(cycle, 3), (std::vector<double>{1, 1, 1, 1, 1, 0.5}));
  EXPECT_EQ(steps_to_and_fro(cycle, 2), (std::vector<double>{1, 1, 1, 0}));
}

// As measured in the encircling operation at 470,000 hexahedra.
TEST(CycleDetector, SeesStatesThatAreNotFarApart) {
  CycleDetector cycle;
  std::vector<double> steps;
  for (double force : {9.04e-5, 7.38e-5, 5.59e-5, 7.38e-5, 5.59e-5, 7.38e-5, 5.59e-5})
    steps.push_back(cycle.longest_step({.force = force}));
  EXPECT_EQ(steps, (std::vector<double>{1, 1, 1, 1, 1, 1, 0.5}));
}

// What followed there: the half step took most of the error, and the rest went to and fro.
TEST(CycleDetector, HalvesTheStepAgainWhereTheErrorHasFallen) {
  CycleDetector cycle;
  std::vector<double> steps;
  for (double force :
       {7.38e-5, 5.59e-5, 7.38e-5, 5.59e-5, 7.38e-5, 5.59e-5, 1.47e-5, 1.92e-5, 1.77e-5, 1.92e-5, 1.77e-5})
    steps.push_back(cycle.longest_step({.force = force}));
  EXPECT_EQ(steps, (std::vector<double>{1, 1, 1, 1, 1, 0.5, 1, 1, 1, 1, 0.5}));
}

TEST(CycleDetector, TakesWholeStepsWhileTheErrorFallsOrCreeps) {
  CycleDetector falling, creeping;
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(falling.longest_step({.force = std::pow(0.5, i)}), 1);
    EXPECT_EQ(creeping.longest_step({.force = 1e-3 * std::pow(.99, i) * (i % 2 ? 1.01 : 1)}), 1);
  }
}

}  // namespace
}  // namespace bulbus
