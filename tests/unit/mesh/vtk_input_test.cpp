#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/vtk/vtk.hpp"
#include "tests/support/foreign_meshes.hpp"
#include "tests/support/refusal.hpp"

namespace bulbus {
namespace {

using test::legacy_vtk_text;
using test::vtu_text;

ReadMesh read_vtu(const std::string& text, const std::string& regions = "region") {
  const std::string path =
      (std::filesystem::temp_directory_path() / ("bulbus_input_" + std::to_string(getpid()) + ".vtu"))
          .string();
  std::ofstream(path, std::ios::binary) << text;
  const std::unique_ptr<const std::string, void (*)(const std::string*)> remover(
      &path, [](const std::string* p) { std::filesystem::remove(*p); });
  return read_vtk(path, regions);
}

void expect_vtu_refused(const std::string& text, const std::vector<std::string>& parts,
                        const std::string& regions = "region") {
  test::expect_refusal([&] { read_vtu(text, regions); }, parts);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// Four cells in a row, the last two of another region.
Mesh row() {
  Mesh mesh = generate(BlockShape{.upper = {4, 1, 1}, .nx = 4, .ny = 1, .nz = 1});
  mesh.region = {0, 0, 1, 1};
  mesh.region_names = {"1", "2"};
  mesh.node_sets["end"] = {0, 5};
  return mesh;
}

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.hexes, b.hexes);
  EXPECT_EQ(a.region, b.region);
  EXPECT_EQ(a.region_names, b.region_names);
  EXPECT_EQ(a.node_sets, b.node_sets);
}

TEST(VtkInput, AllWaysToKeepNumbersGiveTheMesh) {
  const Mesh mesh = row();
  for (const bool binary : {false, true})
    for (const bool appended : {false, true})
      for (const bool compressed : {false, true})
        for (const bool wide : {false, true})
          if (binary || !(appended || compressed))
            expect_same(read_vtu(vtu_text(mesh, {binary, appended, compressed, wide})).mesh, mesh);
  for (const bool binary : {false, true}) expect_same(read_vtu(legacy_vtk_text(mesh, binary)).mesh, mesh);
}

TEST(VtkInput, SurfacesAreBoundariesOfRegions) {
  const Mesh mesh = read_vtu(vtu_text(row())).mesh;
  EXPECT_EQ(mesh.surfaces.at("boundary").size(), 18u);
  EXPECT_EQ(mesh.surfaces.at("1/boundary").size(), 9u);
  ASSERT_EQ(mesh.surfaces.at("1/2").size(), 1u);
  const auto x = corners(mesh, mesh.surfaces.at("1/2")[0]);
  EXPECT_NEAR(cross(x[1] - x[0], x[3] - x[0])[0], 1, 1e-14);  // out of region 1
  EXPECT_FALSE(mesh.surfaces.contains("2/1"));
}

TEST(VtkInput, WithoutAnArrayTheMeshIsOneRegion) {
  const std::string text = replaced(vtu_text(row()), "<CellData>", "<OtherData>");
  const Mesh mesh = read_vtu(replaced(text, "</CellData>", "</OtherData>")).mesh;
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"1"}));
  EXPECT_EQ(mesh.surfaces.size(), 1u);
}

TEST(VtkInput, TheArrayOfRegionsMayHaveAnotherName) {
  const std::string text = replaced(vtu_text(row()), "Name=\"region\"", "Name=\"medit:ref\"");
  expect_vtu_refused(text, {".vtu: there is no cell array 'region'", "it has: medit:ref"});
  EXPECT_EQ(read_vtu(text, "medit:ref").mesh.region, row().region);
  expect_vtu_refused(vtu_text(row()), {"there is no cell array 'x'"}, "x");
}

TEST(VtkInput, VoxelsCountOtherwise) {
  Mesh mesh = row();
  for (Hex& h : mesh.hexes) std::swap(h[2], h[3]), std::swap(h[6], h[7]);
  const std::string text = vtu_text(mesh);
  const Mesh read_back = read_vtu(replaced(text, "12 12 12 12", "11 11 11 11")).mesh;
  EXPECT_EQ(read_back.hexes, row().hexes);
}

// As VTK writes them: the last two of three components have no name.
TEST(VtkInput, MetadataOfArraysArePassedOver) {
  const std::string information =
      "\nMETADATA\nCOMPONENT_NAMES\nx\n\n\nINFORMATION 1\nNAME L2_NORM_RANGE LOCATION vtkDataArray\n"
      "DATA 2 0 4.2\n\n";
  expect_same(read_vtu(replaced(legacy_vtk_text(row()), "\nCELLS", information + "CELLS")).mesh, row());
  expect_same(read_vtu(replaced(legacy_vtk_text(row()), "FieldData 1\n",
                                "FieldData 2\nu 3 1 float\n0 0 0" + information))
                  .mesh,
              row());
}

TEST(VtkInput, RefusesOtherCellsWithTheirNumbers) {
  expect_vtu_refused(replaced(vtu_text(row()), "12 12 12 12", "12 10 9 10"),
                     {".vtu: 3 of 4 cells are no 8-node hexahedra: 1 quads, 2 tetrahedra"});
}

TEST(VtkInput, RefusesWhatIsCutOff) {
  const Mesh mesh = row();
  for (const std::string& text : {vtu_text(mesh), vtu_text(mesh, {.binary = true}),
                                  vtu_text(mesh, {.binary = true, .appended = true, .compressed = true}),
                                  legacy_vtk_text(mesh), legacy_vtk_text(mesh, true)})
    for (std::size_t length = 0; length < text.size() - 60; length += 7) try {
        const Mesh part = read_vtu(text.substr(0, length)).mesh;
        EXPECT_EQ(part.hexes.size(), 4u);  // point data at the end may lack
      } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find(".vtu"), std::string::npos);
      }
}

TEST(VtkInput, RefusesNumbersThatDoNotFit) {
  const std::string text = vtu_text(row());
  expect_vtu_refused(replaced(text, "NumberOfCells=\"4\"", "NumberOfCells=\"4000000000\""),
                     {".vtu:", "has 4 numbers instead of 4000000000"});
  expect_vtu_refused(replaced(text, "NumberOfPoints=\"20\"", "NumberOfPoints=\"-20\""),
                     {".vtu:4: NumberOfPoints=\"-20\""});
  expect_vtu_refused(replaced(text, "8 16 24 32", "8 16 24 40"), {"cell 3 is a hexahedron with 16 points"});
  expect_vtu_refused(replaced(text, "UnstructuredGrid\"", "PolyData\""),
                     {".vtu:2: a <VTKFile> of type 'PolyData'"});
  expect_vtu_refused(replaced(text, "header_type", "compressor=\"vtkLZ4DataCompressor\" header_type"),
                     {".vtu:2: data of vtkLZ4DataCompressor"});
  expect_vtu_refused("solid x\n", {"this is no VTK file"});
  const std::string legacy = legacy_vtk_text(row());
  expect_vtu_refused(replaced(legacy, "POINTS 20", "POINTS 2000000000"), {".vtu:5: the file ends too early"});
  expect_vtu_refused(replaced(legacy, "UNSTRUCTURED_GRID", "POLYDATA"),
                     {".vtu:4: a dataset of kind POLYDATA"});
}

}  // namespace
}  // namespace bulbus
