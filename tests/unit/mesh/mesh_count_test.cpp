#include "core/mesh/mesh_count.hpp"

#include <gtest/gtest.h>

#include "core/mesh/refine.hpp"

namespace bulbus {
namespace {

// Nodes where octants meet are counted with each.
template <class Shape>
void expect_counted(const Shape& shape, double more = 0, double less = 0) {
  const Mesh mesh = generate(shape);
  const MeshCount c = count(shape);
  EXPECT_EQ(c.hexes, static_cast<double>(mesh.hexes.size()));
  const double nodes = static_cast<double>(mesh.points.size());
  EXPECT_GE(c.nodes, nodes * (1 - less));
  EXPECT_LE(c.nodes, nodes * (1 + more));
}

TEST(MeshCount, IsThatOfWhatIsGenerated) {
  expect_counted(BlockShape{.nx = 3, .ny = 2, .nz = 5});
  expect_counted(CylinderShape{.n = 3, .rings = 2, .layers = 5});
  for (const char* part : {"octant", "quarter", "half", "whole"}) {
    expect_counted(ShellShape{.n = 4, .layers = 3, .part = part}, .4);
    expect_counted(BallShape{.n = 4, .layers = 3, .part = part}, .4);
  }
}

TEST(MeshCount, GrowsEightfoldWhereItIsRefined) {
  const BlockShape shape{.nx = 2, .ny = 2, .nz = 2};
  EXPECT_EQ(refined(count(shape), 2).hexes,
            static_cast<double>(refined(generate(shape), 2).finest().hexes.size()));
}

TEST(MeshCount, IsBeyondIntegers) {
  EXPECT_EQ(count(BlockShape{.nx = 10000, .ny = 10000, .nz = 10000}).hexes, 1e12);
}

}  // namespace
}  // namespace bulbus
