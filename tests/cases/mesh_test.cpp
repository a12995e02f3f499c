// Meshes and bodies that are wrong, doubled, noisy or in other units.
#include <regex>

#include "tests/cases/changed_case.hpp"

namespace bulbus::test {
namespace {

TEST(HexahedraTwice, AreRefusedWithTheirRegions) {
  expect_refused(run_case("hexahedra_twice"),
                 {"block.msh:122", "element 57 of region 'all'", "element 41 (line 106) of region 'left'",
                  "16 of 32 hexahedra stand twice", "Physical Volume"});
}

TEST(HexahedraTwice, InAnyOrderAndInOneRegion) {
  const auto with = [](int count, const std::string& more) -> Edit {  // in place of the volume `all`
    return [=](const std::string& text) {
      const std::string kept = text.substr(0, text.find("\n57 5") + 1) + more + "$EndElements\n";
      return std::regex_replace(kept, std::regex(R"(\$Elements\n\d+)"),
                                "$$Elements\n" + std::to_string(count));
    };
  };
  const auto scene = std::vector<std::string>{"regions={left: {c10: 50 kPa}, right: {c10: 50 kPa}}"};
  const Ran clean = run_changed("hexahedra_twice", "block.msh", with(56, ""), scene);
  ASSERT_EQ(clean.status, 0) << clean.err;
  EXPECT_NEAR(probe(clean, "F"), 105.556, 1e-3);
  for (const char* nodes : {"24 25 30 29 39 40 45 44", "25 30 29 24 40 45 44 39", "39 40 45 44 24 25 30 29"})
    expect_refused(run_changed("hexahedra_twice", "block.msh",
                               with(57, "57 5 2 2 2 " + std::string(nodes) + "\n"), scene),
                   {"element 57 of region 'right'", "1 of 17 hexahedra stand twice"});
}

// From the lower layer's bottom to the upper layer's top.
TEST(HexahedraTwice, OnOneSideOfAFaceAreRefused) {
  const Edit tall = [](const std::string& text) {
    return text.substr(0, text.find("\n57 5") + 1) + "57 5 2 2 2 9 10 15 14 39 40 45 44\n$EndElements\n";
  };
  const Edit counted = [=](const std::string& text) {
    return std::regex_replace(tall(text), std::regex(R"(\$Elements\n\d+)"), "$$Elements\n57");
  };
  expect_refused(run_changed("hexahedra_twice", "block.msh", counted,
                             {"regions={left: {c10: 50 kPa}, right: {c10: 50 kPa}}"}),
                 {"mesh:", "hexahedron 17 (region 'right') overlaps hexahedron", "(1.75, 0.75, 0) mm",
                  "there are 2 such faces", "Mesh every part of the body once"});
}

TEST(OneName, OfSeveralKindsWithOtherNodesIsRefusedWhereASetIsMeant) {
  const std::string told = "'BASE' is a node set of 3 nodes and a surface of 9 nodes, not the same ones";
  expect_refused(run_case("one_name"), {"s.yaml:4", "fix.0.set", told, "Rename one of the two"});
  for (const char* use :
       {"probes=[{name: p, kind: position, set: BASE}]", "steps.0.displace=[{set: BASE, z: 0.1}]",
        "sutures={s: {body: none, sets: [BASE, TOP]}}"})
    expect_refused(run_case("one_name", {"fix=[{set: TOP}]", use}), {told});
}

TEST(OneName, IsNoneWhereNodesAreEqualOrTheNameIsASurfaceAlone) {
  const Edit renamed = replacing("*NSET,NSET=BASE", "*NSET,NSET=three");
  const Ran by_surface = run_changed("one_name", "block.inp", renamed);
  ASSERT_EQ(by_surface.status, 0) << by_surface.err;
  const double held = probe(by_surface, "u");
  EXPECT_NEAR(held, .189, 5e-4);
  const Ran equal = run_changed("one_name", "block.inp", replacing("1,3,7\n", "1,2,3,4,5,6,7,8,9\n"));
  ASSERT_EQ(equal.status, 0) << equal.err;
  EXPECT_EQ(probe(equal, "u"), held);
  const Ran pressed =
      run_case("one_name", {"fix=[{set: TOP}]", "steps.0.loads=[{surface: BASE, pressure: 1 kPa}]"});
  EXPECT_EQ(pressed.status, 0) << pressed.err;
}

// Whatever node set has the name of a side: its nodes lie on those of the other side, and are no slip.
TEST(OneName, OfTheSidesOfAContactMeansTheSurfaces) {
  const Edit with_points = [](const std::string& text) {
    std::string more = replacing("6\n2 1 \"bottom\"", "7\n0 9 \"high_bottom\"\n2 1 \"bottom\"")(text);
    more = replacing("$Elements\n192\n", "$Elements\n193\n")(more);
    return replacing("$EndElements", "193 15 2 9 9 250\n$EndElements")(more);
  };
  expect_no_warning(run_changed("matching_nodes", "two.msh", with_points));
}

TEST(BarsOnPlanes, WithTheShareOfAWholeAreWarnedOf) {
  const auto figures = [](const Ran& run) {
    return std::array{probe(run, "pull"), probe(run, "mean"), probe(run, "largest")};
  };
  const Ran quarter = run_case("bars_on_planes");
  expect_warning(quarter, {"3 of 4 bars 'S' lie in a plane of symmetry", "'S share=0.5'"});
  const double too_stiff = probe(quarter, "pull");
  const Ran whole = run_case("bars_on_planes", {"mesh.file=whole.msh", "symmetry=[]"});
  expect_no_warning(whole);
  const auto wanted = figures(whole);
  EXPECT_GT(too_stiff, 1.2 * wanted[0]);
  const Edit shares = [](const std::string& text) {  // bars 1 to 4: both planes, x = 0, y = 0, none
    std::string more =
        replacing("7\n1 1 \"S\"", "9\n1 1 \"S\"\n1 8 \"S share=0.5\"\n1 9 \"S share=0.25\"")(text);
    for (const auto& [bar, group] : {std::pair{"1 1 2 1 1 5 9", "1 1 2 9 9 5 9"},
                                     {"2 1 2 1 1 7 11", "2 1 2 8 8 7 11"},
                                     {"3 1 2 1 1 6 10", "3 1 2 8 8 6 10"}})
      more = replacing(bar, group)(more);
    return more;
  };
  const Ran right = run_changed("bars_on_planes", "quarter.msh", shares);
  expect_no_warning(right);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(figures(right)[k] / wanted[k], 1, 1e-6) << k;
}

TEST(AlikeNames, ThatRecordsCannotTellApartAreRefused) {
  const Edit regions = [](const std::string& text) {
    return replaced(replaced(text, "\"left\"", "\"wall/left\""), "\"right\"", "\"wall_left\"");
  };
  expect_refused(run_changed("coincident_nodes", "block.msh", regions,
                             {"regions={wall/left: {c10: 50 kPa}, wall_left: {c10: 50 kPa}}"}),
                 {"'wall/left' and 'wall_left' would have one name", "Rename one"});
  const std::string probes =
      "probes=[{name: a/b, kind: position, set: xmin}, {name: a|b, kind: position, set: xmax}]";
  expect_refused(run_case("partitioned_mesh", {probes}), {"probes.1.name", "'a/b' and 'a|b'"});
  expect_refused(run_case("partitioned_mesh",
                          {"rigid_bodies={a/b: {sphere: {center: [9, 9, 9], radius: 1}}, a<b: {sphere: "
                           "{center: [19, 9, 9], radius: 1}}}"}),
                 {"rigid_bodies.", "would have one name"});
}

TEST(PartitionedMesh, IsReadAsTheWhole) {
  for (const char* mesh : {"block.msh", "block2.msh"}) {
    const Ran run = run_case("partitioned_mesh", {std::string("mesh.file=") + mesh});
    expect_no_warning(run);
    EXPECT_NEAR(probe(run, "F"), 105.556, 1e-3) << mesh;
  }
}

TEST(PartitionedMesh, TakesGroupsFromTheParents) {
  const Edit without_groups = [](const std::string& text) {
    return std::regex_replace(text, std::regex(R"((\n[12]0\d [23] \d 1 [12] 0 0 0 2 1 1) 1 \d+ 0)"),
                              "$1 0 0");
  };
  const Ran run = run_changed("partitioned_mesh", "block.msh", without_groups);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(probe(run, "F"), 105.556, 1e-3);
}

TEST(PartitionedMesh, OneFileOfSeveralIsRefused) {
  expect_refused(run_changed("partitioned_mesh", "block.msh", replacing("202 3 1 1 2", "202 3 1 1 1")),
                 {"block.msh:", "volumes of 1 of its 2 parts", "PartitionSplitMeshFiles"});
}

std::string warnings_of_sheet(const std::vector<std::string>& set) {
  const Ran run = run_case("one_layer_sheet", set);
  EXPECT_EQ(run.status, 0) << run.err;
  return run.summary()["warnings"].dump();
}

TEST(OneLayerSheet, HeldOnBothFacesByOneSetIsWarnedOf) {
  const std::string thickened = "set 'both' has all eight nodes of 16 hexahedra";
  EXPECT_NE(warnings_of_sheet({}).find(thickened), std::string::npos);
  EXPECT_EQ(warnings_of_sheet({"mesh.refine=0"}).find(thickened), std::string::npos);
  EXPECT_EQ(warnings_of_sheet({"steps.0.displace=[{set: low, z: 0}, {set: high, z: 0}, {set: xmax, x: 1}]"})
                .find("all eight nodes"),
            std::string::npos);
}

TEST(OneLayerSheet, OneSurfaceForBothFacesHasTheSidesTooAndIsWarnedOf) {
  const auto warnings = [](const std::string& condition) {
    return warnings_of_sheet({"mesh.refine=0", "mesh.surfaces.pressed=" + condition});
  };
  EXPECT_NE(warnings("Z < 0.01 || Z > 0.99").find("surface 'pressed' has all eight nodes of 16 hexahedra"),
            std::string::npos);
  EXPECT_EQ(warnings("Z > 0.99").find("all eight nodes"), std::string::npos);
}

TEST(SymmetryNoise, IsReadAsThePlane) {
  for (const char* scene : {"clean.yaml", "noise.yaml"}) {
    const Ran run = run_case("symmetry_noise", {}, scene);
    expect_no_warning(run);
    EXPECT_NEAR(probe(run, "mises_least"), 158.333, 1e-3) << scene;
    EXPECT_NEAR(probe(run, "mises_most"), 158.333, 1e-3) << scene;
    EXPECT_NEAR(probe(run, "gap_at_plane"), 0, 1e-12) << scene;
  }
}

TEST(SymmetryNoise, IsGoneBeforeConditionsAreAsked) {
  const Ran run =
      run_case("symmetry_noise", {"mesh.sets.flat=X < 1e-9", "probes.gap_at_plane.set=flat"}, "noise.yaml");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(probe(run, "gap_at_plane"), 0, 1e-12);
}

TEST(SymmetryNoise, BeyondTheToleranceIsRefused) {
  expect_refused(
      run_case("symmetry_noise", {"symmetry_tolerance=1e-9"}, "noise.yaml"),
      {"symmetry:", "lie along the symmetry plane x = 0", "1e-07 mm", "symmetry_tolerance: 1.1e-07 mm"});
  const Edit coarser = [](const std::string& text) {
    EXPECT_NE(text.find("1e-07"), std::string::npos);
    return std::regex_replace(text, std::regex("1e-07"), "1e-03");
  };
  expect_refused(run_changed("symmetry_noise", "noise.msh", coarser, {}, "noise.yaml"),
                 {"0.001 mm", "symmetry_tolerance: 0.0011 mm"});
  const Ran run =
      run_changed("symmetry_noise", "noise.msh", coarser, {"symmetry_tolerance=0.0011"}, "noise.yaml");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(probe(run, "mises_most"), 158.333, 1e-3);
}

TEST(Scale, MetresAreAskedForAndScaled) {
  expect_warning(run_case("scale_and_tolerance", {}, "metres.yaml"), {"0.0191 mm", "metres", "scale: 1000"});
  const Ran run = run_case("scale_and_tolerance", {"mesh.scale=1000"}, "metres.yaml");
  expect_no_warning(run);
  EXPECT_NEAR(probe(run, "r"), 11.0865, 1e-3);
  EXPECT_NEAR(probe(run, "V"), 4288.93, .05);
  expect_refused(run_case("scale_and_tolerance", {"mesh.scale=0"}, "metres.yaml"), {"mesh.scale"});
}

TEST(Scale, NoiseAndFiveDigitsAreRead) {
  for (const char* scene : {"noisy.yaml", "rounded.yaml"}) {
    const Ran run = run_case("scale_and_tolerance", {}, scene);
    expect_no_warning(run);
    EXPECT_NEAR(probe(run, "r"), 11.0865, 1e-3) << scene;
    EXPECT_NEAR(probe(run, "V"), 4288.93, .05) << scene;
  }
}

TEST(MeshCoordinates, AreFinite) {
  for (const char* bad : {"nan", "inf", "-inf"})
    expect_refused(run_changed("hexahedra_twice", "block.msh",
                               replacing("\n3 1.0 0.0 0.0", std::string("\n3 1.0 ") + bad + " 0.0")),
                   {"block.msh:20: node 3 has the coordinate"});
}

TEST(Stl, RepeatedFacetsAreLeftOut) {
  const Ran run = run_case("stl_duplicate_facets");
  expect_warning(run, {"lid.stl", "1 facets with two equal corners and 2 that repeat"});
  EXPECT_NEAR(probe(run, "push"), 304.989, .05);
}

TEST(Stl, ATurnedFacetIsRefusedWithItsPlace) {
  expect_refused(run_case("stl_facet_turned"),
                 {"lid.stl:2: 1 of 12 facets is turned", "(-3, -3, 1.5), (3, 3, 1.5), (-3, 3, 1.5)",
                  "Exchange two of its corners"});
}

TEST(Stl, OpenAndBranchedSurfacesAreRefusedWithTheirPlace) {
  const std::string last = "facet normal 0 0 0\n outer loop\n  vertex -3 -3 1.5\n  vertex -3 -3 1.5\n";
  const Edit fin = replacing(last, "facet normal 0 0 0\n outer loop\n  vertex -3 -3 1.5\n  vertex 0 0 5\n");
  expect_refused(run_changed("stl_duplicate_facets", "lid.stl", fin),
                 {"lid.stl:", "belongs to 3 facets", "(-3, -3, 1.5)"});
  const Edit flat =
      replacing(last, "facet normal 0 0 0\n outer loop\n  vertex -3 -3 1.5\n  vertex -3 0 1.5\n");
  expect_refused(run_changed("stl_duplicate_facets", "lid.stl", flat),
                 {"lid.stl:", "has no area", "lie on a line"});
  const Edit hole = [](const std::string& text) {
    return text.substr(0, text.find("facet normal 0 0 1\n")) +
           text.substr(text.find("facet normal 0 -1 0\n"));
  };
  expect_refused(run_changed("stl_duplicate_facets", "lid.stl", hole),
                 {"lid.stl:", "the surface is open", "facet in line"});
}

TEST(Stl, AShellThatIsInsideOutIsRefused) {
  const Edit two = [](const std::string& text) {  // the lid again as a second solid, moved by 9 mm and turned
    const std::string good =
        text.substr(0, text.rfind("facet normal 0 0 -1\n", text.rfind("facet normal 0 0 -1\n") - 1)) +
        "endsolid body\n";
    std::string other = std::regex_replace(good, std::regex("vertex (-?3) (-?3) (\\S+)"), "vertex 1$1 $2 $3");
    other = std::regex_replace(other, std::regex("vertex 1-3"), "vertex 9");
    return good + std::regex_replace(other, std::regex("( *vertex[^\n]*\n)( *vertex[^\n]*\n)"), "$2$1");
  };
  expect_refused(run_changed("stl_duplicate_facets", "lid.stl", two),
                 {"lid.stl:", "inside out", "closed surface 2 of 2"});
}

// One hexahedron on the left, 2 x 2 x 2 on the right: only the corners are common.
TEST(HangingNodes, AreTold) {
  const Ran run = run_case("hanging_nodes");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.summary()["warnings"].dump().find("5 nodes of region 'right' lie on faces of region 'left'"),
            std::string::npos)
      << run.summary()["warnings"].dump();
}

}  // namespace
}  // namespace bulbus::test
