#include "app/eye/tissues.hpp"

#include <gtest/gtest.h>

namespace bulbus {
namespace {

TEST(Tissues, HaveTheirStiffness) {
  EXPECT_EQ(tissue_stiffness("paper", "sclera"), .0833);
  EXPECT_DOUBLE_EQ(*tissue_stiffness("physiological", "sclera"), 6 * .0833);
  EXPECT_EQ(tissue_stiffness("stiff_lens", "sclera"), .0833);
  EXPECT_EQ(tissue_stiffness("paper", "lens"), 1);
  EXPECT_EQ(tissue_stiffness("physiological", "lens"), 1);
  EXPECT_EQ(tissue_stiffness("stiff_lens", "lens"), 100);
  EXPECT_FALSE(tissue_stiffness("none", "lens"));
  EXPECT_FALSE(tissue_stiffness("paper", "lenses"));
}

TEST(Tissues, FillInWhatTheModelLeavesOut) {
  Model model;
  model.regions["lens"].rigid = true;
  model.regions["retina"].c10 = 3;
  add_tissues("physiological", {"lens", "retina", "choroid", "tumour"}, model);
  EXPECT_EQ(model.regions.size(), 3u);
  EXPECT_EQ(model.regions["lens"].c10, 0);
  EXPECT_EQ(model.regions["retina"].c10, 3);
  EXPECT_DOUBLE_EQ(model.regions["choroid"].c10, 6 * .0083);
}

}  // namespace
}  // namespace bulbus
