#include "app/eye/tissues.hpp"

#include <gtest/gtest.h>

namespace bulbus {
namespace {

TEST(Tissues, HaveTheirLaws) {
  EXPECT_EQ(tissue_law("paper", "sclera")->c10, .0833);
  EXPECT_EQ(tissue_law("stiff_lens", "sclera")->c10, .0833);
  EXPECT_EQ(tissue_law("paper", "lens")->c10, 1);
  EXPECT_EQ(tissue_law("physiological", "lens")->c10, 1);
  EXPECT_EQ(tissue_law("stiff_lens", "lens")->c10, 100);
  EXPECT_FALSE(tissue_law("none", "lens"));
  EXPECT_FALSE(tissue_law("paper", "lenses"));
}

TEST(Tissues, OfThePaperAreNeoHookeanAndLivingOnesStiffen) {
  for (const char* tissue : {"cornea", "sclera"}) {
    EXPECT_FALSE(tissue_law("paper", tissue)->fung);
    EXPECT_TRUE(tissue_law("physiological", tissue)->fung);
  }
}

TEST(Tissues, FillInWhatTheModelLeavesOut) {
  Model model;
  model.regions["lens"].rigid = true;
  model.regions["retina"].c10 = 3;
  add_tissues("physiological", {"lens", "retina", "choroid", "tumour"}, model);
  EXPECT_EQ(model.regions.size(), 3u);
  EXPECT_EQ(model.regions["lens"].c10, 0);
  EXPECT_EQ(model.regions["retina"].c10, 3);
  EXPECT_DOUBLE_EQ(model.regions["choroid"].c10, .1);
}

}  // namespace
}  // namespace bulbus
