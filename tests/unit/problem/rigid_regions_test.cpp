#include "tests/support/two_regions.hpp"
#include "tests/unit/problem/standing_block.hpp"

namespace bulbus {
namespace {

TEST_F(FilledShell, RigidHexahedraKeepTheirVolumeInTheBalance) {
  Problem p(scene.mesh, scene.model, world());
  State s = p.initial_state();
  p.begin_step(0, s);
  const EquilibriumError b = p.equilibrium_error(p.residual(s));
  EXPECT_LT(b.volume, 1e-13);
  s = shaken(p, s, .02, 3);
  const Residual r = p.residual(s);
  double worst = 0;
  for (std::size_t e = 0; e < r.volume.size(); ++e)
    worst = worse(worst, std::abs(r.volume[e]) / p.solid().reference_volumes()[e]);
  EXPECT_DOUBLE_EQ(p.equilibrium_error(r).volume, world().max(worst));
  EXPECT_GT(worst, 1e-4);
}

TEST(RigidRegions, AreHeldOnlyByThePlanesThatCutThem) {
  // A quarter model (x, y >= 0) of two blocks: one at the corner, one beside the plane y = 0 but on x = 0.
  Scene s{generate(BlockShape{.nx = 2, .ny = 1, .nz = 1, .region = "soft"}), {}};
  Mesh hard = generate(BlockShape{.lower = {0, 2, 0}, .upper = {1, 3, 1}, .region = "hard"});
  hard.surfaces = {{"hard_top", hard.surfaces.at("zmax")}};
  append(s.mesh, hard);
  s.model.regions = {{"soft", neo_hooke(1)}, {"hard", rigid()}};
  s.model.symmetry = {"x", "y"};
  s.model.fix.push_back({"zmin", {"z"}});
  for (int n : {4, 5, 10, 11})  // to the soft block, inclined, so that nothing is left free
    for (int m = 0; m < 8; ++m) s.mesh.bars["ties"].push_back({at_node(n), at_node(12 + m)});
  s.model.bars["ties"] = {};
  s.model.steps = {step("only")};
  const Problem p(s.mesh, s.model, world());
  EXPECT_EQ(p.dofs().bodies()[0].free(), (std::array<bool, 6>{false, true, true, true, false, false}));
}

TEST(RigidRegions, BalanceCountsTheResultantOnABody) {
  Scene scene = standing_block();
  split_region(scene.mesh, "lid", [](const Point& p) { return p[2] > 2; });
  scene.model.regions["lid"] = rigid();
  scene.model.steps[0].loads.push_back(force("zmax", {0, 0, 1}));
  Problem p(scene.mesh, scene.model, world());
  State s = at_end_of_step(p);
  const EquilibriumError b = p.equilibrium_error(p.residual(s));
  EXPECT_EQ(b.region, "lid");
  EXPECT_DOUBLE_EQ(b.force, 1);
}

TEST(RigidRegions, BalanceCountsTheMomentOnABody) {
  Scene scene = standing_block();
  split_region(scene.mesh, "lid", [](const Point& p) { return p[2] > 2; });
  scene.model.regions["lid"] = rigid();
  scene.mesh.node_sets["left"] =
      nodes_where(scene.mesh, [](const Point& p) { return p[2] == 3 && p[0] == 0; });
  scene.mesh.node_sets["right"] =
      nodes_where(scene.mesh, [](const Point& p) { return p[2] == 3 && p[0] == 2; });
  scene.model.steps[0].loads = {force("left", {0, 0, 1}), force("right", {0, 0, -1})};
  Problem p(scene.mesh, scene.model, world());
  State s = at_end_of_step(p);
  const Residual r = p.residual(s);
  EXPECT_NEAR(norm(r.bodies[0].force), 0, 1e-14);
  expect_near(r.bodies[0].moment, {0, -6, 0});
  EXPECT_EQ(p.equilibrium_error(r).region, "lid");
  EXPECT_GT(p.equilibrium_error(r).force, .5);
}

// Less than rounding leaves in a stiff region elsewhere, but not in the one that the body is joined to.
TEST(RigidRegions, BalanceOfABodyIsThatOfTheRegionsAroundIt) {
  Scene scene = row_of_four({0, 1, 1, 2}, {"stiff", "soft", "lid"});
  scene.model.regions["stiff"] = neo_hooke(500);
  scene.model.regions["lid"] = rigid();
  scene.model.steps[0].loads.push_back(force("xmax", {2.5e-6, 0, 0}));
  Problem p(scene.mesh, scene.model, world());
  State s = at_end_of_step(p);
  const EquilibriumError b = p.equilibrium_error(p.residual(s));
  EXPECT_EQ(b.region, "lid");
  EXPECT_NEAR(b.force, 1, 1e-9);
}

// Forces of a stiff neighbour and reactions meet in its nodes: they say nothing of its own balance.
TEST(Regions, AreNotHiddenByTheirStiffNeighbour) {
  Scene scene = row_of_four({0, 0, 1, 1}, {"stiff", "soft"});
  scene.model.regions["stiff"] = neo_hooke(500);
  scene.model.regions["soft"] = neo_hooke(5e-4);
  scene.mesh.node_sets["joint"] = nodes_where(scene.mesh, [](const Point& p) { return p[0] == 2; });
  scene.mesh.node_sets["middle"] = nodes_where(scene.mesh, [](const Point& p) { return p[0] == 1; });
  scene.model.fix.push_back({"joint", {"x", "y", "z"}});
  scene.model.fix.push_back({"middle", {"y", "z"}});
  Problem p(scene.mesh, scene.model, world());
  State s = at_end_of_step(p);
  for (int h = 0; h < static_cast<int>(s.lambda.size()); ++h)
    if (p.mesh().input_hex[h] < 2) s.lambda[h] = 500;
  for (int n = 0; n < p.mesh().nodes(); ++n)
    if (p.mesh().X[3 * n] == 4) s.x[3 * n + 1] += .1;
  const EquilibriumError b = p.equilibrium_error(p.residual(s));
  EXPECT_EQ(b.region, "soft");
  EXPECT_GT(b.force, .1);
}

}  // namespace
}  // namespace bulbus
