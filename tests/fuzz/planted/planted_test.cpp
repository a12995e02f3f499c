// The fuzz test finds what is wrong: faults that are put into the program under test.
#include <gtest/gtest.h>

#include "core/base/process.hpp"

namespace bulbus {
namespace {

Ended with_plant(const std::string& plant) {
  std::vector<std::string> arguments{BULBUS_FUZZ, "--kind", "body", "--first", "10", "--mutants", "16"};
  if (!plant.empty()) arguments.insert(arguments.end(), {"--plant", plant});
  return run_process(arguments);
}

TEST(Fuzz, FindsWhatIsPlanted) {
  for (const char* plant : {"exception", "crash", "stack", "memory", "silent", "no_remedy"}) {
    const Ended end = with_plant(plant);
    EXPECT_TRUE(end.ran) << plant;
    EXPECT_EQ(end.status, 1) << plant;
  }
}

TEST(Fuzz, FindsAHang) { EXPECT_EQ(with_plant("hang").status, 1); }

TEST(Fuzz, FindsNothingElse) { EXPECT_EQ(with_plant("").status, 0); }

}  // namespace
}  // namespace bulbus
