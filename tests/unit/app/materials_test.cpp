#include <gtest/gtest.h>

#include "app/scene/scene.hpp"
#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;

const std::string sclera_block = R"yaml(mesh: {block: {region: sclera}}
materials: physiological
symmetry: [x, y, z]
steps:
  - displace: [{set: xmax, x: .1}]
solver: {linear: {method: direct}}
)yaml";

RegionSpec resolved(const Ran& r) {
  return parse_scene(r.text("resolved.yaml"), "resolved.yaml").model.regions.at("sclera");
}

TEST(Materials, ComeOutResolved) {
  const Ran r = run_scene(sclera_block);
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_NEAR(resolved(r).c10, .4998, 1e-15);
  EXPECT_NEAR(resolved(run_scene(sclera_block, {"materials=paper"})).c10, .0833, 1e-15);
  const Ran own = run_scene(sclera_block, {"regions.sclera.c01=.2"});
  EXPECT_EQ(resolved(own).c10, 0);
  EXPECT_EQ(resolved(own).c01, .2);
}

TEST(Materials, AreNotTakenUnlessTheSceneSaysSo) {
  const Ran r = run_scene(replaced(sclera_block, "materials: physiological", "regions: {}"));
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.err.find("scene.yaml:2: regions: region 'sclera' of the mesh has no material\n"
                       "  Add `sclera: {c10: ...}` under `regions`, or say `materials: paper`."),
            std::string::npos)
      << r.err;
  EXPECT_NE(run_scene(sclera_block, {"materials=papier"}).err.find("did you mean 'paper'?"),
            std::string::npos);
}

}  // namespace
