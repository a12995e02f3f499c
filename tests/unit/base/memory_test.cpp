#include "core/base/memory.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

using namespace bulbus;

TEST(LargePages, HoldWhatAVectorHoldsAndBeginAtAPage) {
  for (std::size_t n : {1, 1000, 3000000}) {
    std::vector<float, LargePages<float>> v(n, 1.5f);
    v.resize(2 * n, 2.5f);
    EXPECT_EQ(v.front(), 1.5f);
    EXPECT_EQ(v[n - 1], 1.5f);
    EXPECT_EQ(v.back(), 2.5f);
    if (n > 1000000) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(v.data()) % (2 << 20), 0u);
  }
}
