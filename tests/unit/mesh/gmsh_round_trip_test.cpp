#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "app/eye/eye.hpp"
#include "core/mesh/generate/embed.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/gmsh/gmsh.hpp"
#include "core/mesh/quality.hpp"
#include "tests/support/not_empty.hpp"

namespace bulbus {
namespace {

struct RoundTrip : testing::TestWithParam<GmshFormat> {
  Mesh operator()(const Mesh& mesh) const {
    const std::string path =
        (std::filesystem::temp_directory_path() / ("bulbus_round_trip_" + std::to_string(getpid()) + ".msh"))
            .string();
    write_gmsh(mesh, path, GetParam());
    Mesh read = read_gmsh(path);
    std::filesystem::remove(path);
    return read;
  }
};

Mesh block_with_everything() {
  BlockShape shape;
  shape.nx = 2;
  Mesh mesh = generate(shape);
  mesh.region_names = {"left", "right"};
  mesh.region = {0, 1};
  mesh.node_sets["corner"] = {0};
  mesh.bars["fibres"] = {{at_node(0), at_node(4), 1}, {at_node(1), at_node(5), .5}};
  return mesh;
}

TEST_P(RoundTrip, KeepsAllThatABlockHas) {
  const Mesh mesh = block_with_everything(), read = (*this)(mesh);
  EXPECT_EQ(read.points, mesh.points);
  EXPECT_EQ(read.hexes, mesh.hexes);
  EXPECT_EQ(read.region, mesh.region);
  EXPECT_EQ(read.region_names, mesh.region_names);
  EXPECT_EQ(read.surfaces, mesh.surfaces);
  EXPECT_EQ(read.node_sets, mesh.node_sets);
  ASSERT_EQ(read.bars.size(), 1u);
  const std::vector<Bar>& bars = read.bars.at("fibres");
  ASSERT_EQ(bars.size(), 2u);
  double share = 0;
  for (const Bar& bar : not_empty(bars)) {
    share += bar.share;
    EXPECT_EQ(sole_node(bar.b), sole_node(bar.a) + 4);
  }
  EXPECT_EQ(share, 1.5);
}

TEST_P(RoundTrip, TurnsCellsAndFacesThatAreInsideOut) {
  const Mesh mesh = block_with_everything();
  Mesh turned = mesh;
  for (Hex& h : turned.hexes) h = {h[4], h[5], h[6], h[7], h[0], h[1], h[2], h[3]};
  for (auto& [name, quads] : turned.surfaces)
    for (Quad& q : quads) std::swap(q[1], q[3]);
  ASSERT_LT(hex_volume(turned, 0), 0);
  const Mesh read = (*this)(turned);
  EXPECT_EQ(read.hexes, mesh.hexes);
  EXPECT_NO_THROW(refuse_inverted(read));
  Point volume{};
  for (const Quad& q : read.surfaces.at("outside")) volume = volume + volume_flux(corners(read, q));
  for (double v : volume) EXPECT_NEAR(v, 1, 1e-12);
}

TEST_P(RoundTrip, DropsNodesThatNothingUses) {
  Mesh mesh = block_with_everything();
  mesh.points.push_back({9, 9, 9});
  EXPECT_EQ((*this)(mesh).points.size(), mesh.points.size() - 1);
}

TEST_P(RoundTrip, KeepsTheEyeAndItsEmbeddedBars) {
  EyeSettings settings;
  settings.n = 8;
  const Mesh mesh = generate(settings), read = (*this)(mesh);
  EXPECT_EQ(read.points, mesh.points);
  EXPECT_EQ(read.region_names, mesh.region_names);
  EXPECT_EQ(read.surfaces.at("cavity").size(), mesh.surfaces.at("cavity").size());
  EXPECT_EQ(read.node_sets, mesh.node_sets);
  std::vector<int> count(7), expected(7);
  for (int r : read.region) ++count[r];
  for (int r : mesh.region) ++expected[r];
  EXPECT_EQ(count, expected);
  const auto ends = [](const Mesh& m) {
    std::vector<std::array<double, 7>> all;
    for (const Bar& b : m.bars.at("zonules")) {
      const Point p = position(m, b.a), q = position(m, b.b);
      all.push_back({b.share, p[0], p[1], p[2], q[0], q[1], q[2]});
    }
    std::stable_sort(all.begin(), all.end(), [](auto& a, auto& b) { return a[0] < b[0]; });
    return all;
  };
  const auto a = ends(mesh), b = ends(read);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int j = 0; j < 7; ++j) EXPECT_NEAR(a[i][j], b[i][j], 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Gmsh, RoundTrip,
                         testing::Values(GmshFormat{true, true}, GmshFormat{true, false},
                                         GmshFormat{false, true}, GmshFormat{false, false}),
                         [](const auto& info) {
                           return std::string(info.param.version4 ? "msh41" : "msh22") +
                                  (info.param.binary ? "_binary" : "_ascii");
                         });

}  // namespace
}  // namespace bulbus
