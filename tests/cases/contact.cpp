// Contacts that were passed through, asymmetric or not solved.
#include "tests/cases/run_case.hpp"

namespace bulbus::test {
namespace {

TEST(ThinSheet, IsCarriedAlongInTenIncrements) {
  const Ran run = run_case("thin_sheet", {"steps.0.increments=10"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(probe(run, "lowest"), -.4, 1e-3);
  EXPECT_NEAR(probe(run, "push"), 9.488, .01);
}

}  // namespace
}  // namespace bulbus::test
