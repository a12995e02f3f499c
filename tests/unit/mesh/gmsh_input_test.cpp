#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>

#include "core/base/error.hpp"
#include "core/mesh/gmsh/gmsh.hpp"
#include "tests/support/refusal.hpp"

namespace bulbus {
namespace {

const std::string msh_nodes =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 "
    "1\n7 1 1 1\n"
    "8 0 1 1\n9 5 5 5\n$EndNodes\n";  // 15 lines
const std::string cube = "1 5 2 7 1 1 2 3 4 5 6 7 8\n";

std::string elements(const std::string& lines) {
  return "$Elements\n" + std::to_string(std::count(lines.begin(), lines.end(), '\n')) + "\n" + lines +
         "$EndElements\n";
}

Mesh read_msh(const std::string& text) {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("bulbus_input_" + std::to_string(getpid()) + ".msh"))
          .string();
  std::ofstream(path) << text;
  const std::unique_ptr<const std::string, void (*)(const std::string*)> remover(
      &path, [](const std::string* p) { std::filesystem::remove(*p); });
  return read_gmsh(path);
}

void expect_msh_refused(const std::string& text, const std::vector<std::string>& parts) {
  test::expect_refusal([&] { read_msh(text); }, parts);
}

TEST(GmshInput, NamesAreMadeUpWhereTheyLack) {
  const Mesh mesh = read_msh(msh_nodes + elements(cube + "2 3 2 4 1 1 2 3 4\n3 15 2 3 1 8\n4 1 2 2 1 1 7\n"));
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"region_7"}));
  EXPECT_EQ(mesh.points.size(), 8u);
  EXPECT_EQ(mesh.surfaces.at("surface_4").at(0), (Quad{0, 3, 2, 1}));  // turned outwards
  EXPECT_EQ(mesh.node_sets.at("points_3"), (std::vector<int>{7}));
  EXPECT_EQ(mesh.bars.at("bars_2").size(), 1u);
}

TEST(GmshInput, GroupsOfOneNameAreCollected) {
  const std::string names = "$PhysicalNames\n2\n0 1 \"points\"\n0 2 \"points\"\n$EndPhysicalNames\n";
  const Mesh mesh = read_msh(msh_nodes + names + elements(cube + "2 15 2 1 1 1\n3 15 2 2 2 4\n"));
  EXPECT_EQ(mesh.node_sets.at("points"), (std::vector<int>{0, 3}));
}

TEST(GmshInput, BarsMayEndOnAFace) {
  std::string text = msh_nodes;
  text.replace(text.find("9 5 5 5"), 7, "9 .5 .25 1");
  const Mesh mesh = read_msh(text + elements(cube + "2 1 2 2 1 9 1\n"));
  const EmbeddedPoint& end = mesh.bars.at("bars_2").at(0).a;
  double sum = 0;
  for (double w : end.weights) sum += w;
  EXPECT_NEAR(sum, 1, 1e-14);
  EXPECT_EQ(mesh.points.size(), 8u);
}

TEST(GmshInput, SharesOfBarsAreAboveZeroAndUpToOne) {
  const auto with = [](const std::string& group) {
    return msh_nodes + "$PhysicalNames\n1\n1 1 \"" + group + "\"\n$EndPhysicalNames\n" +
           elements(cube + "2 1 2 1 1 1 8\n");
  };
  for (const auto& [text, share] : {std::pair{"1", 1.}, {"0.5", .5}, {".25", .25}, {"1e-3", 1e-3}})
    EXPECT_EQ(read_msh(with(std::string("S share=") + text)).bars.at("S").at(0).share, share) << text;
  EXPECT_EQ(read_msh(with("share=3")).bars.at("share=3").at(0).share, 1) << "a name of its own";
  for (const char* wrong : {"-0.5", "3", "0", "1e400", "1e-400", "nan", "inf", "0,5", "0.5 ", "", "half"})
    expect_msh_refused(with(std::string("S share=") + wrong),
                       {"element 2 is a bar of the group 'S share=" + std::string(wrong) + "'", "share=0.5"});
}

TEST(GmshInput, RefusesOtherElementsWithTheirLine) {
  expect_msh_refused(msh_nodes + elements(cube + "2 4 2 7 1 1 2 3 4\n"),
                     {".msh:19: element 2 is a tetrahedron", "Recombine 3D"});
  expect_msh_refused(msh_nodes + elements(cube + "2 2 2 7 1 1 2 3\n"), {".msh:19: element 2 is a triangle"});
  expect_msh_refused(msh_nodes + elements(cube + "2 12 2 7 1 1 2 3\n"),
                     {"type 12, of higher order", "Mesh.ElementOrder = 1"});
  expect_msh_refused(
      msh_nodes + elements(cube + "2 4 2 7 1 1 2 3 4\n3 2 2 7 1 1 2 3\n4 4 2 7 1 1 2 3 5\n"),
      {".msh:19: element 2 is a tetrahedron: 3 of 4 cells are no 8-node hexahedra: 2 tetrahedra, "
       "1 triangles"});
}

TEST(GmshInput, RefusesElementsThatDoNotFit) {
  expect_msh_refused(msh_nodes + elements("1 5 2 0 1 1 2 3 4 5 6 7 8\n"),
                     {".msh:18: element 1", "no physical group", "Physical Volume"});
  expect_msh_refused(msh_nodes + elements(cube + "2 3 2 4 1 1 2 3 9\n"),
                     {".msh:19: element 2 of surface 'surface_4' is no face"});
  expect_msh_refused(msh_nodes + elements(cube + "2 3 2 4 1 1 2 3 5\n"),
                     {".msh:19: element 2 of surface 'surface_4' is no face"});
  expect_msh_refused(msh_nodes + elements(cube + "2 15 2 4 1 9\n"),
                     {".msh:19: element 2 of the points 'points_4'"});
  expect_msh_refused(msh_nodes + elements(cube + "2 1 2 4 1 1 9\n"),
                     {".msh:19: element 2 is a bar with an end"});
  expect_msh_refused(msh_nodes + elements("1 5 2 7 1 1 2 3 4 5 6 7 88\n"),
                     {".msh:18: element 1 has node 88"});
}

// Reversed entities are groups with a minus, and the least int has no opposite.
TEST(GmshInput, RefusesGroupsThatCannotBeTurned) {
  for (const char* tag : {"-2147483648", "2147483648", "-9223372036854775808"})
    expect_msh_refused(msh_nodes + elements(std::string("1 5 2 ") + tag + " 1 1 2 3 4 5 6 7 8\n"),
                       {".msh:18: " + std::string(tag) + " is too large for a tag"});
  EXPECT_EQ(read_msh(msh_nodes + elements("1 5 2 -2147483647 1 1 2 3 4 5 6 7 8\n")).hexes.size(), 1u);
}

TEST(GmshInput, RefusesFilesThatAreNoMesh) {
  EXPECT_THROW(read_gmsh("/no/such/mesh.msh"), InputError);
  expect_msh_refused("", {"$MeshFormat is missing"});
  expect_msh_refused("solid cube\n", {"$MeshFormat is missing"});
  expect_msh_refused("$MeshFormat\n4 0 8\n$EndMeshFormat\n", {".msh:2: MSH version 4 is not read", "4.1"});
  expect_msh_refused(msh_nodes, {"no hexahedra"});
  expect_msh_refused(msh_nodes + "$Elements\n3\n" + cube, {"the file ends too early"});
  expect_msh_refused(msh_nodes + elements("1 5 2 7 x 1 2 3 4 5 6 7 8\n"),
                     {".msh:18: 'x' is no whole number"});
}

}  // namespace
}  // namespace bulbus
