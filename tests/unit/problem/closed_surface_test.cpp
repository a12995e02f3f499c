#include "core/problem/closed_surface.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/mesh/generate/generate.hpp"

namespace bulbus {
namespace {

using Planes = std::vector<std::string>;

void check(const Mesh& mesh, const std::string& surface, const Planes& planes) {
  require_closed(mesh, mesh.surfaces.at(surface), planes, surface, "liquids.l.surface");
}

TEST(RequireClosed, AcceptsAWholeCavity) {
  EXPECT_NO_THROW(check(generate(ShellShape{.n = 2, .layers = 1, .part = "whole"}), "inner", {}));
}

TEST(RequireClosed, AcceptsACavityThatSymmetryPlanesClose) {
  EXPECT_NO_THROW(check(generate(ShellShape{.n = 2, .layers = 1, .part = "half"}), "inner", {"x"}));
  EXPECT_NO_THROW(
      check(generate(ShellShape{.n = 2, .layers = 1, .part = "octant"}), "inner", {"x", "y", "z"}));
}

TEST(RequireClosed, NamesTheOpenEdgeWhereAPlaneIsMissing) {
  const Mesh octant = generate(ShellShape{.n = 1, .layers = 1});
  try {
    check(octant, "inner", {"x", "y"});
    FAIL();
  } catch (const InputError& e) {
    const std::string what = e.what();
    EXPECT_EQ(e.key, "liquids.l.surface");
    EXPECT_NE(what.find("'inner' does not enclose a volume: its edge from ("), std::string::npos) << what;
    EXPECT_NE(what.find("symmetry"), std::string::npos);
    // both ends lie on z = 0
    EXPECT_NE(what.find(", 0) to ("), std::string::npos) << what;
    EXPECT_NE(what.find(", 0) mm is open"), std::string::npos) << what;
  }
}

TEST(RequireClosed, RefusesASurfaceWithAHole) {
  Mesh block = generate(BlockShape{.nx = 2, .ny = 2, .nz = 2});
  EXPECT_NO_THROW(check(block, "outside", {}));
  block.surfaces["outside"].pop_back();
  EXPECT_THROW(check(block, "outside", {}), InputError);
}

TEST(AxisOf, NumbersTheAxes) {
  EXPECT_EQ(axis_of("x"), 0);
  EXPECT_EQ(axis_of("z"), 2);
}

}  // namespace
}  // namespace bulbus
