#include "contact/rigid/stl.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "tests/unit/contact/bodies.hpp"

namespace bulbus {
namespace {

struct Stl : testing::Test {
  std::string path = testing::TempDir() + "body.stl";
  void TearDown() override { std::filesystem::remove(path); }

  void write(const std::string& bytes) const { std::ofstream(path, std::ios::binary) << bytes; }
  std::string refusal() const {
    try {
      read_stl(path);
    } catch (const InputError& fault) {
      return fault.what();
    }
    return "accepted";
  }
};

std::string text_of(const RigidSurface& b, bool turn = false) {
  std::ostringstream out;
  out.precision(17);
  out << "solid  of a name\n";
  for (int t = 0; t < static_cast<int>(b.facets.triangles.size()); ++t) {
    const Facet f(b, t);
    out << "  facet normal 0 0 0\n    outer loop\n";
    for (int i : {0, turn ? 2 : 1, turn ? 1 : 2})
      out << "      vertex " << f.corners[i][0] << ' ' << f.corners[i][1] << ' ' << f.corners[i][2] << '\n';
    out << "    endloop\n  endfacet\n";
  }
  out << "endsolid  of a name\n";
  return out.str();
}

std::string binary_of(const RigidSurface& b) {
  std::string bytes = "solid, says this binary header all the same";
  bytes.resize(80);
  const auto put = [&](const auto& v) { bytes.append(reinterpret_cast<const char*>(&v), sizeof v); };
  put(static_cast<std::uint32_t>(b.facets.triangles.size()));
  for (int t = 0; t < static_cast<int>(b.facets.triangles.size()); ++t) {
    const Facet f(b, t);
    for (double c : f.normal) put(static_cast<float>(c));
    for (const auto& corner : f.corners)
      for (double c : corner) put(static_cast<float>(c));
    put(std::uint16_t{0});
  }
  return bytes;
}

RigidSurface ball() { return body({.sphere = SphereShape{{1, 2, 3}, 2, 4}}); }

TEST_F(Stl, TextKeepsTrianglesAndMergesCorners) {
  write(text_of(ball()));
  const SurfaceTriangulation s = read_stl(path);
  EXPECT_EQ(s.triangles.size(), ball().facets.triangles.size());
  EXPECT_EQ(s.points.size(), ball().places.size());
  EXPECT_DOUBLE_EQ(enclosed_volume(s.points, s.triangles),
                   enclosed_volume(ball().places, ball().facets.triangles));
}

TEST_F(Stl, BinaryIsToldByItsSize) {
  write(binary_of(ball()));
  const SurfaceTriangulation s = read_stl(path);
  EXPECT_EQ(s.triangles.size(), ball().facets.triangles.size());
  EXPECT_EQ(s.points.size(), ball().places.size());
  EXPECT_NEAR(enclosed_volume(s.points, s.triangles), enclosed_volume(ball().places, ball().facets.triangles),
              1e-5);
}

TEST_F(Stl, SeveralSolidsAreOneSurface) {
  const std::string one = text_of(body({.sphere = SphereShape{{9, 0, 0}, 1, 2}}));
  write(text_of(ball()) + one);
  EXPECT_EQ(read_stl(path).triangles.size(), ball().facets.triangles.size() + 32);
}

TEST_F(Stl, NegativeZeroIsZero) {
  write(
      "solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n"
      "facet normal 0 0 1 outer loop vertex -0 0 -0.0 vertex 0 1 0 vertex -1 0 0 endloop "
      "endfacet\nendsolid\n");
  EXPECT_EQ(read_stl(path).size(), 4);
}

TEST_F(Stl, TrianglesWithoutAreaOfEqualCornersAreLeftOut) {
  write(
      "solid\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n"
      "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 0 0 0 vertex 0 1 0 endloop endfacet\nendsolid\n");
  EXPECT_EQ(read_stl(path).triangles.size(), 1u);
}

TEST_F(Stl, FaultsNameTheLine) {
  std::string text = text_of(ball());
  const auto broken = [&](const std::string& from, const std::string& to) {
    std::string t = text;
    t.replace(t.find(from), from.size(), to);
    write(t);
    return refusal();
  };
  EXPECT_NE(broken("outer", "inner").find("body.stl:3: expected outer, found 'inner'"), std::string::npos);
  EXPECT_NE(broken("vertex 1", "vertex one").find("body.stl:4: 'one"), std::string::npos);
  EXPECT_NE(broken("endloop", "vertex 1 2 3").find("body.stl:7: expected endloop"), std::string::npos);
  EXPECT_NE(broken("facet normal 0", "facet normal nan").find("accepted"),
            std::string::npos);  // normals are not used
  EXPECT_NE(broken("vertex 1", "vertex nan").find("finite"), std::string::npos);
  write(text.substr(0, text.find("vertex") + 6));
  EXPECT_NE(refusal().find("too early"), std::string::npos);
  write("solid\nendsolid\n");
  EXPECT_NE(refusal().find("no triangles"), std::string::npos);
  write(binary_of(ball()).substr(0, 200));
  EXPECT_NE(refusal(), "accepted");
  write("ply\n");
  EXPECT_NE(refusal().find("neither"), std::string::npos);
  std::filesystem::remove(path);
  EXPECT_NE(refusal().find("cannot read"), std::string::npos);
}

struct StlBody : Stl {
  std::string body_refusal() const {
    try {
      body({.file = BodyFile{path}});
    } catch (const InputError& fault) {
      return fault.what();
    }
    return "accepted";
  }
};

TEST_F(StlBody, MustBeClosedAndTheRightSideOut) {
  write(text_of(ball()));
  EXPECT_EQ(body_refusal(), "accepted");
  write(text_of(ball(), true));
  EXPECT_NE(body_refusal().find("inside out"), std::string::npos);
  const std::string text = text_of(ball());
  const auto second = text.find("facet normal", text.find("facet normal") + 5);
  write("solid\n" + text.substr(second));
  EXPECT_NE(body_refusal().find("open"), std::string::npos);
}

}  // namespace
}  // namespace bulbus
