#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/scene/scene.hpp"
#include "tests/support/run_scene.hpp"

namespace {

using namespace bulbus;
using namespace bulbus::test;
using nlohmann::json;

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
  ASSERT_TRUE(resolved(r).fung);
  EXPECT_GT(resolved(r).fung->a, .1);
  EXPECT_EQ(resolved(r).c10, 0);
  EXPECT_NEAR(resolved(run_scene(sclera_block, {"materials=paper"})).c10, .0833, 1e-15);
  const Ran own = run_scene(sclera_block, {"regions.sclera.c01=.2"});
  EXPECT_EQ(resolved(own).c10, 0);
  EXPECT_EQ(resolved(own).c01, .2);
  EXPECT_FALSE(resolved(own).fung);
}

// σ_xx = a exp(b (Ī1 − 3)) (λ² − 1/λ), on a section of 1/λ.
TEST(Materials, FungsLawIsAKeyOfARegion) {
  const std::string probes = "probes: [{name: pull, kind: reaction, set: xmax, component: x, of: part}]\n";
  const Ran r = run_scene(sclera_block + probes, {"regions.sclera={fung: {a: 200 kPa, b: 3}}"});
  ASSERT_EQ(r.status, 0) << r.err;
  const double l = 1.1, I1 = l * l + 2 / l;
  EXPECT_NEAR(json::parse(r.text("summary.json"))["probes"]["pull"],
              .2 * std::exp(3 * (I1 - 3)) * (l * l - 1 / l) / l, 1e-7);
}

TEST(Materials, FibresAreAKeyOfARegion) {
  const std::string fibres =
      "{c10: .1, fibres: {k1: 50 kPa, k2: 2, dispersion: .1, families: [{direction: [1, 1, "
      "0]}, {angle: 30 deg, axis: [1, 0, 0], center: [-3, -2, 1]}]}}";
  const Ran r = run_scene(sclera_block, {"regions.sclera=" + fibres});
  ASSERT_EQ(r.status, 0) << r.err;
  const RegionSpec law = resolved(r);
  ASSERT_TRUE(law.fibres);
  EXPECT_EQ(law.fibres->families.size(), 2u);
  EXPECT_NEAR(*law.fibres->families[1].angle, M_PI / 6, 1e-15);
}

TEST(Materials, KeysOfTwoLawsExcludeEachOther) {
  for (const auto& [law, message] :
       {std::pair{"{c10: .1, fung: {a: 1, b: 2}}", "`fung` is the whole law of a region"},
        {"{rigid: true, fung: {a: 1, b: 2}}", "a rigid region has no law"},
        {"{fung: {a: 1}}", "the key 'b' is missing"},
        {"{fung: {a: 1, b: 0}}", "regions.sclera.fung.b"},
        {"{c10: .1, c20: 1, fibres: {k1: 1, k2: 1, families: [{angle: 0}]}}",
         "`fibres` stand beside c10 alone"},
        {"{fibres: {k1: 1, k2: 1, families: [{angle: 0}]}}", "initial shear modulus"},
        {"{c10: .1, fibres: {k1: 1, k2: 1, families: []}}", "there is no family of fibres"},
        {"{c10: .1, fibres: {k1: 1, k2: 1, families: [{}]}}", "needs either `direction` or `angle`"},
        {"{c10: .1, fibres: {k1: 1, k2: 1, families: [{direction: [1, 0]}]}}", "has three formulas, not 2"},
        {"{c10: .1, fibres: {k1: 1, k2: 1, families: [{direction: [0, 0, 0]}]}}", "have no direction"},
        {"{c10: .1, fibres: {k1: 1, k2: 1, families: [{direction: [s, 0, 0]}]}}", "families.0.direction"},
        {"{c10: .1, fibres: {k1: 1, k2: 1, dispersion: .4, families: [{angle: 0}]}}", "dispersion"}}) {
    const Ran r = run_scene(sclera_block, {std::string("regions.sclera=") + law});
    EXPECT_EQ(r.status, 2) << law;
    EXPECT_NE(r.err.find(message), std::string::npos) << law << "\n" << r.err;
  }
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
