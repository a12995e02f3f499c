#include "contact/surfaces/slave_surface.hpp"

#include <gtest/gtest.h>

#include "tests/support/sheets.hpp"

namespace bulbus {
namespace {

TEST(SlaveSurface, AreasAddUpToThoseOfTheFaces) {
  Sheets s;
  const auto faces = s.add(5, 4, [](double u, double v) {
    return Vec3<double>{2 * u + .3 * u * u, v + .1 * u * v, 0};
  });
  const SlaveSurface surface(s.X, s.nodes(), faces, {}, {});
  double sum = 0, exact = 0;
  for (double a : surface.shape(s.X).areas) sum += a;
  for (const Quad& q : faces)
    exact += norm(cross(minus(at(s.X, q[2]), at(s.X, q[0])), minus(at(s.X, q[3]), at(s.X, q[1])))) / 2;
  EXPECT_NEAR(sum, exact, 1e-14);
}

// A face is counted where its first corner is owned, though its own nodes may all be the master's as well.
TEST(SlaveSurface, KeepsFacesWhoseOwnedNodesAreTheMasters) {
  const std::vector<double> X{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::vector<Quad> faces{{0, 1, 2, 3}};
  const std::vector<int> excluded{0, 1};
  const SlaveSurface surface(X, 2, faces, excluded, {});
  EXPECT_EQ(surface.faces().size(), 1u);
  EXPECT_TRUE(surface.nodes().empty());
}

TEST(SlaveSurface, NormalsPointOutOfASphere) {
  Sheets s;
  const auto faces = s.add(40, 40, [](double u, double v) {
    const double a = u - .5, b = v - .5, c = std::sqrt(1 - a * a - b * b);
    return Vec3<double>{a, b, c};
  });
  const SlaveSurface surface(s.X, s.nodes(), faces, {}, {});
  const auto normals = surface.shape(s.X).normals;
  for (int i = 0; i < s.nodes(); ++i) EXPECT_GT(dot(normals[i], at(s.X, i)), .9995);
}

TEST(SlaveSurface, KeepsNormalsInSymmetryPlanes) {
  Sheets s;
  const auto faces = s.add(4, 3, [](double u, double v) { return Vec3<double>{u, v, -u * u - .3 * u}; });
  const std::vector<std::string> planes{"x"};
  const auto plain = SlaveSurface(s.X, s.nodes(), faces, {}, {}).shape(s.X),
             cut = SlaveSurface(s.X, s.nodes(), faces, {}, planes).shape(s.X);
  for (int i = 0; i < s.nodes(); ++i) {
    if (s.X[3 * i] == 0) {
      EXPECT_GT(plain.normals[i][0], .1);
      EXPECT_EQ(cut.normals[i][0], 0);
      EXPECT_NEAR(norm(cut.normals[i]), 1, 1e-15);
    } else {
      EXPECT_EQ(cut.normals[i], plain.normals[i]);
    }
  }
}

TEST(SlaveSurface, LeavesOutExcludedAndForeignNodesButCountsTheirFaces) {
  Sheets s;
  const auto faces = s.add(3, 3, [](double u, double v) { return Vec3<double>{u, v, u * v}; });
  const auto whole = SlaveSurface(s.X, s.nodes(), faces, {}, {}).shape(s.X);
  const std::vector<int> excluded{0, 4};
  const SlaveSurface part(s.X, 8, faces, excluded, {});
  EXPECT_EQ(std::vector<int>(part.nodes().begin(), part.nodes().end()), (std::vector<int>{1, 2, 3, 5, 6, 7}));
  const auto shape = part.shape(s.X);
  for (std::size_t i = 0; i < part.nodes().size(); ++i) {
    EXPECT_DOUBLE_EQ(shape.areas[i], whole.areas[part.nodes()[i]]);
    EXPECT_EQ(shape.normals[i], whole.normals[part.nodes()[i]]);
  }
}

}  // namespace
}  // namespace bulbus
