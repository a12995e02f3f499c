#include "app/eye/eye_count.hpp"

#include <gtest/gtest.h>

namespace bulbus {
namespace {

TEST(EyeCount, IsThatOfWhatIsGenerated) {
  for (const EyeSettings& s :
       {EyeSettings{.n = 4}, EyeSettings{.n = 6}, EyeSettings{.n = 14}, EyeSettings{.n = 8, .layers = 2}}) {
    const Mesh mesh = generate(s);
    const MeshCount c = count(s);
    EXPECT_EQ(c.hexes, static_cast<double>(mesh.hexes.size()));
    const double nodes = static_cast<double>(mesh.points.size());
    EXPECT_GE(c.nodes, .97 * nodes);
    EXPECT_LE(c.nodes, nodes);
  }
}

}  // namespace
}  // namespace bulbus
