#include "core/problem/validate.hpp"
#include "core/problem/region_material.hpp"

#include <gtest/gtest.h>

#include "core/base/error.hpp"
#include "core/problem/idle_keys.hpp"
#include "tests/support/models.hpp"

namespace bulbus {
namespace {

/// A block held at its bottom and pulled at its top, with bars and a liquid-free rest: fit to be broken.
Scene sound() {
  Scene s = stretched_block(2, "0.1");
  s.mesh.bars["ties"] = {{at_node(0), at_node(26)}};
  s.mesh.node_sets["none"] = {};
  s.model.bars["ties"] = {};
  return s;
}

void expect_refused(const Scene& scene, const std::string& key, const std::string& fragment) {
  try {
    validate(scene.mesh, scene.model);
    ADD_FAILURE() << "accepted: " << key;
  } catch (const InputError& e) {
    EXPECT_EQ(e.key, key);
    EXPECT_NE(std::string(e.what()).find(fragment), std::string::npos) << e.what();
  }
}

TEST(Validate, AcceptsASoundModel) {
  const Scene s = sound();
  EXPECT_NO_THROW(validate(s.mesh, s.model));
}

TEST(Validate, RegionWithoutMaterial) {
  Scene s = sound();
  s.model.regions.clear();
  expect_refused(s, "regions", "'block' of the mesh has no material");
}

TEST(Validate, MaterialWithoutRegionGuessesTheName) {
  Scene s = sound();
  s.model.regions["blok"] = neo_hooke(1);
  expect_refused(s, "regions.blok", "Did you mean 'block'?");
}

TEST(Validate, ModulusMustBePositive) {
  for (double c : {0.0, -1.0, double(NAN)}) {
    Scene s = sound();
    s.model.regions["block"] = neo_hooke(c);
    expect_refused(s, "regions.block", "must be positive");
  }
}

TEST(Validate, BarsWithoutStiffness) {
  Scene s = sound();
  s.model.bars.clear();
  expect_refused(s, "bars", "'ties' of the mesh have no stiffness");
}

TEST(Validate, StiffnessWithoutBars) {
  Scene s = sound();
  s.model.bars["tis"] = {};
  expect_refused(s, "bars.tis", "Did you mean 'ties'?");
}

TEST(Validate, UnknownAndEmptySets) {
  Scene s = sound();
  s.model.fix.push_back({"zmix", {"z"}});
  expect_refused(s, "fix.0.set", "zmi");
  s.model.fix[0].set = "none";
  expect_refused(s, "fix.0.set", "set 'none' is empty");
}

TEST(Validate, UnknownSurfaces) {
  Scene s = sound();
  s.model.liquids["water"].surface = "zmx";
  expect_refused(s, "liquids.water.surface", "no surface 'zmx'");
  s.model.liquids.clear();
  LoadSpec load;
  load.surface = "top", load.pressure = "1";
  s.model.steps[0].loads.push_back(load);
  expect_refused(s, "steps.0.loads.0.surface", "no surface 'top'");
}

TEST(Validate, LoadsNeedASize) {
  Scene s = sound();
  s.model.steps[0].loads.push_back({});
  expect_refused(s, "steps.0.loads.0", "without size");
}

TEST(Validate, DisplacementsNeedAValueAndDirections) {
  Scene s = sound();
  DisplaceSpec& d = s.model.steps[0].displace[0];
  d.z.reset();
  expect_refused(s, "steps.0.displace.0", "nothing is prescribed");
  d.by = "1";
  expect_refused(s, "steps.0.displace.0.by", "no direction");
  d.by.reset();
  d.affine = std::vector<double>(8);
  expect_refused(s, "steps.0.displace.0.affine", "8 numbers");
  d.affine->resize(9);
  d.translate = Point{0, 0, 1};
  expect_refused(s, "steps.0.displace.0.affine", "together");
  d.affine.reset(), d.translate.reset();
  d.radial = "1", d.axis = {0, 0, 0};
  expect_refused(s, "steps.0.displace.0", "axis");
}

TEST(Validate, MeshOnBothSidesOfASymmetryPlane) {
  Scene s = sound();
  for (Point& p : s.mesh.points) p[1] -= .5;
  expect_refused(s, "symmetry", "both sides of the symmetry plane y = 0");
}

TEST(Validate, SymmetryPlaneThatMeetsNoNode) {
  for (const double shift : {.5, -1.5}) {
    Scene s = sound();
    for (Point& p : s.mesh.points) p[1] += shift;
    expect_refused(s, "symmetry", "no node lies on the symmetry plane y = 0");
  }
}

TEST(Validate, BarsHaveALength) {
  Scene s = sound();
  s.mesh.bars["ties"].push_back({at_node(1), at_node(1)});
  expect_refused(s, "bars.ties", "bar 2 of 'ties' has no length");
}

TEST(Validate, StepsAreNeeded) {
  Scene s = sound();
  s.model.steps.clear();
  expect_refused(s, "steps", "no steps");
}

TEST(Validate, ProbesNeedTheirLiquidAndSet) {
  Scene s = sound();
  ProbeSpec p;
  p.name = "a", p.kind = "pressure", p.liquid = "water";
  s.model.probes = {p};
  expect_refused(s, "probes.0.liquid", "no liquid 'water'");
  s.model.probes[0].kind = "displacement", s.model.probes[0].set = "zmaxx";
  expect_refused(s, "probes.0.set", "zmaxx");
}

// W = c10 (Ī1 − 3) + c11 (Ī1 − 3)(Ī2 − 3) + c (Ī2 − 3)³ at a stretch of 1.5
TEST(Validate, FixedSetsHaveDirections) {
  Scene s = sound();
  s.model.fix = {{.set = "zmin", .directions = {}}};
  expect_refused(s, "fix.0.directions", "no direction");
}

TEST(Validate, OnlyBandsAreShortened) {
  Scene s = sound();
  s.model.rigid_bodies["lid"].plane.emplace();
  s.model.rigid_bodies["belt"].band.emplace();
  s.model.steps[0].move = {{.body = "belt", .shorten = 1}};
  EXPECT_NO_THROW(validate(s.mesh, s.model));
  s.model.steps[0].move.push_back({.body = "lid", .shorten = 1});
  expect_refused(s, "steps.0.move.1.shorten", "no circumference");
}

TEST(IdleKeys, OfDisplacementsAreRefused) {
  const auto refused = [](const std::string& key, auto change) {
    Scene s = sound();
    change(s.model.steps[0].displace.at(0));
    expect_refused(s, "steps.0.displace.0." + key, "has no effect");
  };
  refused("x", [](DisplaceSpec& d) { d = {.set = d.set, .x = "0.1", .translate = Point{0.1, 0, 0}}; });
  refused("by", [](DisplaceSpec& d) {
    d = {.set = d.set, .by = "0.1", .along = {1, 0, 0}, .affine = std::vector<double>(9)};
  });
  refused("along", [](DisplaceSpec& d) { d.along = {1, 0, 0}; });
  refused("axis", [](DisplaceSpec& d) { d = {.set = d.set, .axis = {1, 0, 0}, .rotate = RotationSpec{}}; });
  refused("center", [](DisplaceSpec& d) { d.center = {1, 0, 0}; });
  refused("from", [](DisplaceSpec& d) {
    d = {.set = d.set, .affine = std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1}, .from = "start"};
  });
}

TEST(IdleKeys, OfLoadsAreRefused) {
  const auto refused = [](const std::string& key, const LoadSpec& load) {
    Scene s = sound();
    s.model.steps[0].loads = {load};
    expect_refused(s, "steps.0.loads.0." + key, "has no effect");
  };
  refused("direction", {.surface = "zmax", .pressure = "0.01", .direction = {1, 0, 0}});
  refused("set", {.surface = "zmax", .set = "zmax", .pressure = "0.01"});
  refused("region",
          {.surface = "zmax", .region = "typo", .pressure = "0.01", .dead = true, .direction = {1, 0, 0}});
  refused("surface", {.surface = "zmax", .set = "zmax", .force = Point{1, 0, 0}});
  refused("dead", {.set = "zmax", .dead = true, .force = Point{1, 0, 0}});
  Scene both = sound();
  both.model.steps[0].loads = {{.surface = "xmax", .pressure = "0.01", .dead = true, .direction = {0, 1, 0}}};
  EXPECT_NO_THROW(validate(both.mesh, both.model));
}

TEST(IdleKeys, OfProbesAreRefused) {
  const auto refused = [&](const std::string& key, const ProbeSpec& probe) {
    try {
      refuse_idle_keys(probe, "probes.0");
      ADD_FAILURE() << "accepted: " << key;
    } catch (const InputError& fault) {
      EXPECT_EQ(fault.key, "probes.0." + key);
    }
  };
  refused("statistic", {.name = "a", .kind = "reaction", .set = "zmax", .statistic = "max"});
  refused("statistic", {.name = "a", .kind = "mises", .statistic = "min"});
  refused("percentile", {.name = "a", .kind = "displacement", .set = "zmax", .percentile = 99});
  refused("component", {.name = "a", .kind = "mises", .component = "x"});
  refused("region", {.name = "a", .kind = "displacement", .set = "zmax", .region = "block"});
  refused("set", {.name = "a", .kind = "volume_ratio", .set = "zmax"});
  refused("tolerance", {.name = "a", .kind = "mises", .tolerance = 0.2});
  EXPECT_NO_THROW(refuse_idle_keys({.name = "a", .kind = "mises", .statistic = "max"}, "probes.0"));
  EXPECT_NO_THROW(refuse_idle_keys({.name = "a", .kind = "gap", .set = "s", .contact = "c"}, "probes.0"));
}

TEST(MaterialOf, JoinsNamedAndFreeTerms) {
  RegionSpec r = neo_hooke(1);
  r.c11 = 2;
  r.terms = {{0, 3, 3}};
  const double l = 1.5, I1 = l * l + 2 / l - 3, I2 = 2 * l + 1 / (l * l) - 3;
  const Sym3<double> b{l * l, 1 / l, 1 / l, 0, 0, 0};
  const Material law = material_of(r);
  ASSERT_TRUE(std::holds_alternative<Isotropic<Polynomial>>(law));
  const double W = std::get<Isotropic<Polynomial>>(law).energy(b);
  EXPECT_NEAR(W, r.c10 * I1 + 2 * I1 * I2 + 3 * I2 * I2 * I2, 1e-13);
}

}  // namespace
}  // namespace bulbus
