#include <gtest/gtest.h>

#include <algorithm>

#include "app/eye/eye.hpp"
#include "core/base/error.hpp"
#include "core/mesh/distributed/partition.hpp"
#include "core/mesh/generate/generate.hpp"

namespace bulbus {
namespace {

TEST(Partition, OfOneIsTrivial) { EXPECT_EQ(partition(generate(BlockShape{}), 1), (std::vector<int>{0})); }

TEST(Partition, IsBalancedAndRepeatable) {
  const Mesh mesh = generate(EyeSettings{});
  for (int parts : {2, 3, 8}) {
    const std::vector<int> rank = partition(mesh, parts);
    EXPECT_EQ(rank, partition(mesh, parts));
    std::vector<int> count(parts);
    for (int r : rank) ++count.at(r);
    const double fair = static_cast<double>(mesh.hexes.size()) / parts;
    EXPECT_LT(*std::max_element(count.begin(), count.end()), 1.05 * fair) << parts;
    EXPECT_GT(*std::min_element(count.begin(), count.end()), .8 * fair) << parts;
  }
}

TEST(Partition, RefusesMorePartsThanCells) { EXPECT_THROW(partition(generate(BlockShape{}), 2), InputError); }

}  // namespace
}  // namespace bulbus
