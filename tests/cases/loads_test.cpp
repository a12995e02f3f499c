// Pressures, forces and liquids on surfaces and sets that leave open where they act.
#include "tests/cases/changed_case.hpp"

namespace bulbus::test {
namespace {

TEST(PressureBetweenRegions, AsksForTheRegion) {
  for (const char* folder : {"pressure_between_regions", "pressure_between_regions/swapped"}) {
    expect_refused(run_case(folder), {"s.yaml:", "loads.0.surface", "'left'", "'right'", "region: left"});
    expect_refused(run_case(folder, {"steps.0.loads.0.region=lefd"}),
                   {"loads.0.region", "Did you mean 'left'?"});
    for (const auto& [region, middle] : {std::pair{"left", -.0128293}, {"right", .0128293}}) {
      const Ran run = run_case(folder, {std::string("steps.0.loads.0.region=") + region});
      ASSERT_EQ(run.status, 0) << run.err;
      EXPECT_NEAR(probe(run, "middle"), middle, 1e-6);
    }
  }
}

TEST(PressureBetweenRegions, HasNoSideIfDeadInADirection) {
  const Ran run = run_case("pressure_between_regions",
                           {"steps.0.loads.0.dead=true", "steps.0.loads.0.direction=[-1, 0, 0]"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_LT(probe(run, "middle"), -.01);
}

TEST(PressureBetweenRegions, NoLiquidAndNoContactIsThere) {
  expect_refused(run_case("pressure_between_regions", {"steps.0.loads=[]", "liquids={l: {surface: mid}}"}),
                 {"liquids.l.surface"});
  expect_refused(run_case("pressure_between_regions",
                          {"steps.0.loads=[]", "contacts=[{name: c, slave: mid, master: ymax}]"}),
                 {"contacts.0.slave", "hexahedra on both sides", "nothing can touch"});
}

TEST(PressureOnce, TwoOnOneSurfaceAreRefused) {
  const std::string loads =
      "steps.0.loads=[{surface: xmax, pressure: 1 kPa}, {surface: xmax, pressure: 2 kPa}]";
  const std::vector<std::string> set{"steps.0.displace=[]", loads};
  expect_refused(run_case("partitioned_mesh", set), {"loads.1.surface", "two pressures in one step", "sum"});
  expect_refused(run_case("partitioned_mesh",
                          {"steps.0.displace=[]",
                           "steps.0.loads=[{set: xmax, force: [1, 0, 0]}, {set: xmax, force: [2, 0, 0]}]"}),
                 {"loads.1.set", "two forces"});
}

TEST(ForceOnNodes, OnASetThatRefinementGivesMoreNodesIsRefused) {
  const auto pulled = [](const std::string& set, const std::string& refine) {
    return run_case("partitioned_mesh", {"steps.0.displace=[]", "mesh.refine=" + refine,
                                         "mesh.sets.tip=X > 1.999 && Y < 0.001 && Z < 0.001",
                                         "steps.0.loads=[{set: " + set + ", force: [1e-6, 0, 0]}]"});
  };
  expect_refused(pulled("xmax", "1"), {"loads.0.set", "mesh.refine", "dead: true"});
  EXPECT_EQ(pulled("xmax", "0").status, 0);
  EXPECT_EQ(pulled("tip", "1").status, 0);
}

TEST(ForceOnNodes, OfAPlaneOfSymmetryIsWarnedOf) {
  const auto warned = [](const std::string& symmetry) {
    const Ran run =
        run_case("partitioned_mesh", {"steps.0.displace=[]", "symmetry=" + symmetry, "fix=[{set: xmin}]",
                                      "steps.0.loads=[{set: xmax, force: [1e-6, 0, 0]}]"});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.summary()["warnings"].dump().find("3 of 9 nodes of set 'xmax' lie on a plane") !=
           std::string::npos;
  };
  EXPECT_TRUE(warned("[y]"));
  EXPECT_FALSE(warned("[]"));
}

TEST(PressureOnce, OverlappingSurfacesAreWarnedOf) {
  const Edit second = [](const std::string& text) {  // names the faces of xmax once more
    std::string more = replaced(text, "8\n2 10", "9\n2 99 \"again\"\n2 10");
    return replaced(more, "2 0 0 0 2 1 1 1 11 0", "2 0 0 0 2 1 1 2 11 99 0");
  };
  const Edit both = [=](const std::string& text) {
    return replaced(second(text), "101 2 2 1 1 0 0 0 2 1 1 1 11 0", "101 2 2 1 1 0 0 0 2 1 1 2 11 99 0");
  };
  expect_warning(
      run_changed("partitioned_mesh", "block.msh", both,
                  {"steps.0.displace=[]",
                   "steps.0.loads=[{surface: xmax, pressure: 1 kPa}, {surface: again, pressure: 1 kPa}]"}),
      {"'again'", "'xmax'", "share 4 faces", "add up"});
}

TEST(TwoLiquids, MayNotShareFaces) {
  expect_refused(run_case("two_liquids_one_surface"),
                 {"s.yaml:5", "'one' and 'other' share 48 faces", "surface of its own"});
}

TEST(PressedBoth, IsToBeDivided) {
  for (const char* set : {"steps.0.loads.0.region=left", "steps.0.loads.0.region=right"})
    expect_refused(run_case("pressed_both", {set}),
                   {"faces without a hexahedron of region", "Divide the surface"});
}

}  // namespace
}  // namespace bulbus::test
