#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/mesh/abaqus/abaqus.hpp"
#include "core/mesh/geometry.hpp"
#include "tests/support/refusal.hpp"

namespace bulbus {
namespace {

namespace fs = std::filesystem;

const std::string nodes =
    "*Heading\n** two cubes along z, labels with gaps\n*NODE\n 1,0,0,0\n 2,1,0,0\n 3,1,1,0\n 4,0,1,0\n"
    "11,0.,0.,1.\n12,1.,0.,1.\n13,1.D0,1.,+1.\n14,0.,1.,1e0\n21,0,0,2\n22,1,0,2\n23,1,1,2\n24,,1,2\n"
    "99,5,5,5\n";  // 16 lines
const std::string cubes =
    "*Element, type=C3D8H, elset=Low\n5, 1,2,3,4, 11,12,13,14\n*ELEMENT,TYPE=c3d8r,ELSET=\"High part\"\n"
    "7, 11,12,13,14,\n21,22,23,24\n";  // 5 lines

ReadMesh read_inp(const std::string& text, const std::string& included = "") {
  const fs::path folder = fs::temp_directory_path() / ("bulbus_abaqus_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "m.inp") << text;
  std::ofstream(folder / "more.inc") << included;
  const std::unique_ptr<const fs::path, void (*)(const fs::path*)> remover(
      &folder, [](const fs::path* p) { fs::remove_all(*p); });
  return read_abaqus((folder / "m.inp").string());
}

void expect_inp_refused(const std::string& text, const std::vector<std::string>& parts,
                        const std::string& included = "") {
  test::expect_refusal([&] { read_inp(text, included); }, parts);
}

TEST(AbaqusInput, ElementSetsOfElementsAreRegions) {
  const ReadMesh r = read_inp(nodes + cubes);
  EXPECT_EQ(r.mesh.region_names, (std::vector<std::string>{"Low", "High part"}));
  EXPECT_EQ(r.mesh.region, (std::vector<int>{0, 1}));
  EXPECT_EQ(r.mesh.points.size(), 12u);
  EXPECT_NEAR(hex_volume(r.mesh, 1), 1, 1e-14);
  EXPECT_TRUE(r.notes.empty());
}

TEST(AbaqusInput, AByteOrderMarkIsPassedOver) {
  EXPECT_EQ(read_inp("\xEF\xBB\xBF" + nodes + cubes).mesh.hexes.size(), 2u);
}

TEST(AbaqusInput, SectionsAreRegionsWhereThereAreAny) {
  const ReadMesh r = read_inp(
      nodes + cubes +
      "*ELSET, ELSET=all, GENERATE\n1, 9, 2\n*Solid Section, elset=ALL, material=m\n,\n"
      "*MATERIAL, NAME=m\n*HYPERELASTIC\n1,2\n*STEP\n*BOUNDARY\n1,1,3\n*BOUNDARY\n2,1,3\n*END STEP\n");
  EXPECT_EQ(r.mesh.region_names, (std::vector<std::string>{"all"}));
  ASSERT_EQ(r.notes.size(), 1u);
  EXPECT_EQ(r.notes[0],
            "skipped in the mesh file: *BOUNDARY (2 times), *END STEP, *HYPERELASTIC, *MATERIAL, *STEP");
}

TEST(AbaqusInput, RegionsThatLackOrOverlapAreRefusedWithNumbers) {
  expect_inp_refused(nodes + cubes + "*SOLID SECTION, ELSET=low\n",
                     {"m.inp:20: 1 of 2 elements are in no *SOLID SECTION: element 7"});
  expect_inp_refused(
      nodes + cubes +
          "*ELSET,ELSET=all\nLow,high part\n*SOLID SECTION, ELSET=low\n*SOLID SECTION, ELSET=all\n",
      {"m.inp:25: 1 of 2 elements of 'all'", "element 5 is in 'Low'"});
  expect_inp_refused(nodes + "*ELEMENT,TYPE=C3D8\n5, 1,2,3,4, 11,12,13,14\n",
                     {"m.inp:18: 1 of 1 elements are in no region: element 5", "ELSET"});
  expect_inp_refused(nodes + cubes + "*SOLID SECTION, ELSET=lov\n",
                     {"m.inp:22: there is no element set 'lov'", "'Low'"});
}

TEST(AbaqusInput, SetsByLabelsNamesAndRanges) {
  const Mesh m =
      read_inp(nodes + cubes +
               "*NSET, NSET=\"my set\", GENERATE\n11, 30\n*NSET,\nNSET=two\n1, 99\n\"my set\"\n"
               "*NSET, NSET=of_low, ELSET=LOW\n*NSET, NSET=two\n2,\n*SURFACE, TYPE=NODE, NAME=top\n"
               "21, 1.\n22\n")
          .mesh;
  EXPECT_EQ(m.node_sets.at("my set"), (std::vector<int>{4, 5, 6, 7, 8, 9, 10, 11}));
  EXPECT_EQ(m.node_sets.at("two"),
            (std::vector<int>{0, 1, 4, 5, 6, 7, 8, 9, 10, 11}));  // 99 is of no element
  EXPECT_EQ(m.node_sets.at("of_low"), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_EQ(m.node_sets.at("top"), (std::vector<int>{8, 9}));
}

TEST(AbaqusInput, SurfacesByFacesAndByOuterFaces) {
  const Mesh m = read_inp(nodes + cubes +
                          "*SURFACE, NAME=floor\nLow, S1\n*SURFACE, NAME=side, TYPE=ELEMENT\n5, S3\n7, S3\n"
                          "*SURFACE, NAME=hood\nHigh part,\n")
                     .mesh;
  EXPECT_EQ(m.surfaces.at("floor"), (std::vector<Quad>{{0, 3, 2, 1}}));
  EXPECT_EQ(m.surfaces.at("side"), (std::vector<Quad>{{0, 1, 5, 4}, {4, 5, 9, 8}}));
  EXPECT_EQ(m.surfaces.at("hood").size(), 5u);  // but not the one between the two
}

TEST(AbaqusInput, CellsInsideOutKeepTheirFaces) {
  const Mesh m =
      read_inp(nodes + "*ELEMENT,TYPE=C3D8,ELSET=a\n5, 11,12,13,14, 1,2,3,4\n*SURFACE, NAME=s\n5, S1\n").mesh;
  EXPECT_GT(hex_volume(m, 0), 0);
  for (int n : m.surfaces.at("s").at(0)) EXPECT_EQ(m.points[n][2], 1);
}

const std::string part = "*Part, name=P\n" + nodes + cubes +
                         "*Nset, nset=base\n1,2,3,4\n*Solid Section, elset=Low, material=m\n"
                         "*Solid Section, elset=\"High part\", material=m\n*End Part\n*Assembly, name=A\n";

TEST(AbaqusInput, OneInstanceKeepsTheNamesOfItsPart) {
  const Mesh m =
      read_inp(part +
               "*Instance, name=P-1, part=P\n10., 0, 0\n*End Instance\n*Node\n1, 0,0,0\n"
               "*Nset, nset=rp\n1\n*Nset, nset=two, instance=P-1\n1, 2\n*Nset, nset=three\nP-1.3, P-1.base\n"
               "*Elset, elset=_s_S2, internal, instance=P-1\n7\n*Surface, type=ELEMENT, name=s\n_s_S2, S2\n"
               "*End Assembly\n")
          .mesh;
  EXPECT_EQ(m.region_names, (std::vector<std::string>{"Low", "High part"}));
  EXPECT_EQ(m.points.at(0), (Point{10, 0, 0}));
  EXPECT_EQ(m.node_sets.at("two"), (std::vector<int>{0, 1}));
  EXPECT_EQ(m.node_sets.at("three"), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(m.node_sets.at("base").size(), 4u);
  EXPECT_EQ(m.surfaces.at("s").size(), 1u);
  EXPECT_FALSE(m.node_sets.contains("rp"));
}

TEST(AbaqusInput, SetsOfNoInstanceAreTold) {
  const std::string whole = part + "*Instance, name=P-1, part=P\n*End Instance\n*End Assembly\n";
  EXPECT_TRUE(read_inp(whole).notes.empty());
  const ReadMesh r = read_inp(whole + "*Nset, nset=late\n1, 2\n*Surface, name=side, type=NODE\nlate\n");
  ASSERT_EQ(r.notes.size(), 1u);
  EXPECT_NE(r.notes[0].find("'late', 'side'"), std::string::npos) << r.notes[0];
  EXPECT_FALSE(r.mesh.node_sets.contains("late"));
}

TEST(AbaqusInput, SeveralInstancesAreMovedAndNamed) {
  const Mesh m = read_inp(part +
                          "*Instance, name=a, part=P\n*End Instance\n*Instance, name=b, part=p\n5, 0, 0\n"
                          "5,0,0, 5,0,1, 90\n*End Instance\n*End Assembly\n")
                     .mesh;
  EXPECT_EQ(m.hexes.size(), 4u);
  EXPECT_EQ(m.region_names, (std::vector<std::string>{"a.Low", "a.High part", "b.Low", "b.High part"}));
  const Point p =
      m.points.at(m.node_sets.at("b.base").at(1));  // (1, 0, 0) moved by 5, then turned about (5, 0, ·)
  EXPECT_NEAR(p[0], 5, 1e-14);
  EXPECT_NEAR(p[1], 1, 1e-14);
}

TEST(AbaqusInput, IncludedFilesAreReadInTheirPlace) {
  EXPECT_EQ(read_inp("*INCLUDE, INPUT=more.inc\n" + cubes, nodes).mesh.hexes.size(), 2u);
  expect_inp_refused("*INCLUDE, INPUT=more.inc\n" + cubes, {"more.inc:3: 'x' is no finite number"},
                     "*NODE\n\n1, x\n");
  expect_inp_refused("*INCLUDE, INPUT=none.inc\n", {"m.inp:1: *INCLUDE names 'none.inc', which is no file"});
  expect_inp_refused("*INCLUDE, INPUT=m.inp\n", {"m.inp:1: 'm.inp' includes itself"});
}

TEST(AbaqusInput, RefusesOtherElementsWithTheirNumbers) {
  expect_inp_refused(
      nodes + cubes +
          "*ELEMENT, TYPE=C3D4\n20,1,2,3,11\n21,1,2,3,12\n*ELEMENT, TYPE=S4R, ELSET=s\n22,1,2,3,4\n",
      {"m.inp:22: 3 of 5 cells are no 8-node hexahedra: 2 of type C3D4, 1 of type S4R"});
}

TEST(AbaqusInput, RefusesWhatDoesNotFit) {
  expect_inp_refused("", {"no hexahedra"});
  expect_inp_refused("$MeshFormat\n", {"m.inp:1: this is no Abaqus input"});
  expect_inp_refused(nodes + "*ELEMENT,TYPE=C3D8,ELSET=a\n5, 1,2,3,4, 11,12,13,15\n",
                     {"m.inp:18: element 5 has node 15"});
  expect_inp_refused(nodes + "*ELEMENT,TYPE=C3D8,ELSET=a\n5, 1,2,3,4, 11,12\n",
                     {"m.inp:18: element 5 has 6 of its eight"});
  expect_inp_refused(nodes + "*ELEMENT,TYPE=C3D8,ELSET=a\n5, 1,2,3,4, 11,12,13,14,15\n",
                     {"m.inp:18: element 5 has more"});
  expect_inp_refused(nodes + "1,0,0,0\n" + cubes, {"m.inp:17: node 1 appears twice"});
  expect_inp_refused(nodes + cubes + "8,1,2,3,4,11,12,13,14\n",
                     {"m.inp:22: element 8 has the same eight nodes as element 5"});
  expect_inp_refused(nodes + cubes + "*NSET,NSET=a\n77\n",
                     {"m.inp:23: a set has node 77, which the file lacks"});
  expect_inp_refused(nodes + cubes + "*NSET,NSET=a,GENERATE\n9,1\n", {"m.inp:23: the last number 1 is less"});
  expect_inp_refused(nodes + cubes + "*NSET,NSET=a\nb\n*NSET,NSET=b\na\n", {"contains itself"});
  expect_inp_refused(nodes + cubes + "*SURFACE,NAME=a\n5, S7\n", {"m.inp:23: 'S7' is no face", "S1 to S6"});
  expect_inp_refused(nodes + cubes + "*NGEN\n1,2\n", {"m.inp:22: *NGEN is not read"});
  expect_inp_refused("*NODE, SYSTEM=C\n", {"m.inp:1: nodes in the coordinate system 'C'"});
  expect_inp_refused("*NODE, INPUT=nodes.dat\n" + cubes,
                     {"m.inp:1: *NODE with INPUT='nodes.dat' is not read", "*INCLUDE, INPUT=nodes.dat"});
  expect_inp_refused("*NODE,\n1,0,0,0\n", {"m.inp:1: *NODE continues with the number '1'"});
  expect_inp_refused(part + "*Instance, name=a, part=Q\n", {"is of the part 'Q', which the file lacks"});
}

}  // namespace
}  // namespace bulbus
