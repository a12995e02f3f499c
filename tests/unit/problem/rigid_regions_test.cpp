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

}  // namespace
}  // namespace bulbus
