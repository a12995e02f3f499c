#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <set>

#include "contact/rigid/rigid_shapes.hpp"
#include "contact/rigid/surface_triangulation.hpp"
#include "contact/surfaces/meridians.hpp"
#include "contact/surfaces/sharp_edges.hpp"
#include "core/base/error.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/gmsh/gmsh.hpp"
#include "tests/support/not_empty.hpp"
#include "tests/unit/contact/bodies.hpp"

namespace bulbus {
namespace {

using std::numbers::pi;

double volume(const RigidSurface& b) { return enclosed_volume(b.places, b.facets.triangles); }

// Rims of parts that meet lie on one another.
bool is_closed(const RigidSurface& b) {
  std::multiset<std::array<long, 6>> rims;  // ends of an edge, in units of 1e-9 mm
  for (std::size_t t = 0; t < b.facets.neighbours.size(); ++t)
    for (int i = 0; i < 3; ++i)
      if (b.facets.neighbours[t][i] < 0) {
        std::array<long, 6> ends;
        for (int c = 0; c < 6; ++c)
          ends[c] = std::lround(1e9 * b.reference[3 * b.facets.triangles[t][(i + 1 + c / 3) % 3] + c % 3]);
        rims.insert(ends);
      }
  return std::ranges::all_of(rims, [&](const auto& e) {
    return rims.contains({e[3], e[4], e[5], e[0], e[1], e[2]});
  });
}

template <class Build>
std::string refusal(Build build) {
  try {
    build();
  } catch (const InputError& fault) {
    return fault.key + "|" + fault.what();
  }
  return "accepted";
}

std::vector<std::vector<double>> square(double half) {
  return {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
}

RigidBodySpec swept(std::vector<std::vector<double>> section, ArcSpec arc = {}) {
  SweptShape s;
  s.section = std::move(section);
  s.at = {0, 10};
  s.arc = arc;
  RigidBodySpec spec;
  spec.swept = s;
  return spec;
}

TEST(Shapes, SphereIsClosedAndItsVolumeConverges) {
  double error[2];
  for (int i = 0; i < 2; ++i) {
    const RigidSurface b = body({.sphere = SphereShape{{1, 2, 3}, 2, 8 << i}});
    EXPECT_TRUE(is_closed(b));
    EXPECT_EQ(b.facets.triangles.size(), 8u * (8 << i) * (8 << i));
    for (std::size_t p = 0; p < b.places.size(); p += 3)
      EXPECT_NEAR(std::hypot(b.places[p] - 1, b.places[p + 1] - 2, b.places[p + 2] - 3), 2, 1e-12);
    error[i] = 4. / 3 * pi * 8 - volume(b);
    EXPECT_GT(error[i], 0);
  }
  EXPECT_NEAR(error[0] / error[1], 4, .1);
}

TEST(Shapes, RodHasTheVolumeOfItsPrism) {
  for (const Point axis : {Point{0, 0, 2}, {1, -2, .5}, {-1, 0, 0}}) {
    const RigidSurface b = body({.cylinder = RodShape{{3, -1, 2}, axis, 1.5, 4, 20}});
    EXPECT_TRUE(is_closed(b));
    EXPECT_NEAR(volume(b), 10 * 1.5 * 1.5 * std::sin(2 * pi / 20) * 4, 1e-11);
  }
}

TEST(Shapes, PlaneLooksAlongItsNormal) {
  const RigidSurface b = body({.plane = PlaneShape{{1, 2, 3}, {0, -2, 0}, 6}});
  const Facet f(b, 0), g(b, 1);
  for (const Facet& t : {f, g}) {
    EXPECT_NEAR(t.normal[1], -1, 1e-14);
    EXPECT_NEAR(t.area, 18, 1e-12);
    EXPECT_NEAR(t.middle[1], 2, 1e-14);
  }
  EXPECT_EQ(b.parts[0].inwards, (Vec3<double>{0, -1, 0}));
}

// Between two stations at an angle D the section runs straight: sin(D) A r
TEST(Shapes, SweptVolumeIsThatOfItsWedges) {
  ArcSpec arc{.from = 20, .to = 80, .parts = 3, .facets = 4};
  const double wedge = std::sin(5 * pi / 180);
  const RigidSurface b = body(swept(square(1), arc));
  EXPECT_TRUE(is_closed(b));
  EXPECT_EQ(b.parts.size(), 3u);
  EXPECT_NEAR(volume(b), 12 * wedge * 4 * 10, 1e-10);
  arc = {.from = 0, .to = 360, .facets = 12};
  EXPECT_TRUE(is_closed(body(swept(square(1), arc))));
  EXPECT_NEAR(volume(body(swept(square(1), arc))), 12 * std::sin(pi / 6) * 4 * 10, 1e-10);
}

TEST(Shapes, SweptAboutAnotherAxisIsTheSameBodyTurned) {
  ArcSpec arc{.from = 0, .to = 90, .facets = 6};
  arc.meridians = {{1, 2, 3}, {1, 0, 0}, {0, 1, 1}};
  const RigidSurface b = body(swept({{-1, -1}, {2, -1}, {0, 1}}, arc));
  EXPECT_TRUE(is_closed(b));
  // area 3, centroid at a radius of 10 − 1/3
  EXPECT_NEAR(volume(b), 6 * std::sin(pi / 12) * 3 * (10 - 1. / 3), 1e-10);
}

TEST(Shapes, AzimuthGrowsFromSuperiorToLateral) {
  const MeridianFrame frame(Meridians{}, "");
  const Vec3<double> expected[3] = {{0, 12, 4}, {12, 0, 4}, {0, -12, 4}};
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(frame.place(90 * i, 4, 12)[c], expected[i][c], 1e-14);
}

TEST(Shapes, PartsCloseAgainstTheRadiusOfTheirMiddle) {
  BandShape band;
  band.arc = {.from = 0, .to = 180, .parts = 18, .facets = 2};
  const RigidSurface b = body({.band = band});
  ASSERT_EQ(b.parts.size(), 18u);
  for (int p = 0; p < 18; ++p) {
    const double phi = (5 + 10 * p) * pi / 180;
    EXPECT_NEAR(b.parts[p].inwards[0], -std::sin(phi), 1e-14);
    EXPECT_NEAR(b.parts[p].inwards[1], -std::cos(phi), 1e-14);
    EXPECT_NEAR(b.parts[p].inwards[2], 0, 1e-14);
    EXPECT_NEAR(std::atan2(b.parts[p].center[0], b.parts[p].center[1]), phi, 1e-12);
    for (int t = b.parts[p].first_triangle; t < b.parts[p].first_triangle + b.parts[p].triangles; ++t)
      for (int corner : b.facets.triangles[t]) {
        EXPECT_GE(corner, b.parts[p].first_point);
        EXPECT_LT(corner, b.parts[p].first_point + b.parts[p].points);
      }
  }
  RigidBodySpec together{.band = band};
  together.direction = {0, -3, 0};
  for (const auto& part : not_empty(body(together).parts)) EXPECT_EQ(part.inwards, (Vec3<double>{0, -1, 0}));
}

TEST(Shapes, ArcsWithoutCapsAreOpenAtTheirEndsOnly) {
  ArcSpec arc{.from = 0, .to = 40, .facets = 3};
  arc.caps = false;
  const RigidSurface b = body(swept(square(1), arc));
  int rims = 0;
  for (const auto& n : b.facets.neighbours)
    for (int t : n) rims += t < 0;
  EXPECT_EQ(rims, 8);
}

TEST(Shapes, BandIsARoundedRectangle) {
  BandShape band;
  band.edge_facets = 200;
  band.axial = .5;
  const Profile s = profile_of(band, "");
  EXPECT_NEAR(signed_area(s), 2 * .75 - (4 - pi) * .2 * .2, 1e-5);
  Point2 low = s[0], high = s[0];
  for (const Point2& p : s)
    for (int c = 0; c < 2; ++c) low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
  EXPECT_NEAR(low[0], -.5, 1e-12);
  EXPECT_NEAR(high[0], 1.5, 1e-12);
  EXPECT_NEAR(low[1], 12, 1e-12);
  EXPECT_NEAR(high[1], 12.75, 1e-12);
  band.arc = {.from = 0, .to = 180, .parts = 6, .facets = 10};
  EXPECT_TRUE(is_closed(body({.band = band})));
}

TEST(Shapes, TireIsHollowTowardsTheEye) {
  TireShape tire;
  tire.inner_radius_of_curvature = 9;
  tire.radius = 12.2;
  const Profile s = profile_of(tire, "");
  double narrowest = INFINITY, widest = 0, top = 0;
  int on_face = 0;
  for (const Point2& p : s) {
    const double from_center = std::hypot(p[0], p[1] - 3.2);
    narrowest = std::min(narrowest, from_center);
    on_face += from_center < 9 + 1e-9;
    widest = std::max(widest, std::abs(p[0]));
    top = std::max(top, p[1]);
  }
  EXPECT_NEAR(narrowest, 9, 1e-12);
  EXPECT_EQ(on_face, tire.face_facets + 1);
  EXPECT_NEAR(widest, 3.5, 1e-12);
  EXPECT_NEAR(top, 12.2 + 2.75, 1e-12);
  EXPECT_TRUE(is_closed(body({.tire = tire})));
}

// A ball of the edges' radius rolls along the ends as it does along the edges: nothing there is sharp, and
// the arc is as long as without.
TEST(Shapes, EndsOfArcsAreRoundedAsTheEdgesAre) {
  TireShape tire;
  tire.arc = {.from = 10, .to = 50, .parts = 2, .facets = 12};
  const RigidSurface b = body({.tire = tire});
  EXPECT_TRUE(is_closed(b));
  double first = 90, last = 0;
  for (std::size_t p = 0; p < b.reference.size(); p += 3) {
    const double azimuth = std::atan2(b.reference[p], b.reference[p + 1]) * 180 / pi;
    first = std::min(first, azimuth), last = std::max(last, azimuth);
  }
  EXPECT_NEAR(first, 10, 1e-9);
  EXPECT_NEAR(last, 50, 1e-9);
  EXPECT_TRUE(SharpEdges(b.facets, b.reference, SharpEdges::Kind::convex).empty());
  tire.arc.to = 12;
  EXPECT_THROW(body({.tire = tire}), InputError);
}

// Only the ends of the whole arc are rounded: parts shorter than an edge is round fit where those are not
// free.
TEST(Shapes, ShortPartsFitWhereNoEndIsRounded) {
  BandShape band;
  band.arc = {.from = 0, .to = 180, .parts = 360, .facets = 1};
  const std::vector<std::string> x{"x"};
  EXPECT_EQ(make_rigid_surface("b", {.band = band}, "", x).parts.size(), 360u);
  band.edge_radius = .3;
  EXPECT_THROW(body({.band = band}), InputError);
}

TEST(Shapes, AnEndInAPlaneOfSymmetryIsNotRounded) {
  TireShape tire;
  tire.arc = {.from = 0, .to = 45, .facets = 10};
  const auto widest_at_zero = [&](std::span<const std::string> symmetry) {
    const RigidSurface b = make_rigid_surface("b", {.tire = tire}, "", symmetry);
    double widest = 0;
    for (std::size_t p = 0; p < b.reference.size(); p += 3)
      if (std::abs(b.reference[p]) < 1e-9) widest = std::max(widest, b.reference[p + 2]);
    return widest;
  };
  const std::vector<std::string> x{"x"}, y{"y"};
  EXPECT_NEAR(widest_at_zero(x), 3.5, 1e-12);
  EXPECT_LT(widest_at_zero(y), 3.1);
  EXPECT_LT(widest_at_zero({}), 3.1);
}

// A body goes on beyond a plane of symmetry as its image: what lies in the plane has no edge.
TEST(SharpEdges, EndAtAPlaneOfSymmetry) {
  const RigidSurface rod = body({.cylinder = RodShape{{2, 0, 0}, {1, 0, 0}, 1, 4, 20}});
  const std::vector<std::string> x{"x"}, y{"y"};
  const auto with_edges = [&](std::span<const std::string> symmetry) {  // at which ends there are edges
    const SharpEdges sharp(rod.facets, rod.reference, SharpEdges::Kind::convex, symmetry);
    std::array<bool, 2> ends{};
    for (std::size_t t = 0; t < rod.facets.triangles.size(); ++t)
      for (int other : sharp.of(static_cast<int>(t)))
        for (int corner : rod.facets.triangles[other])
          if (std::ranges::find(rod.facets.triangles[t], corner) != rod.facets.triangles[t].end())
            ends[rod.reference[3 * corner] > 2] = true;
    return ends;
  };
  EXPECT_EQ(with_edges({}), (std::array{true, true}));
  EXPECT_EQ(with_edges(y), (std::array{true, true}));
  EXPECT_EQ(with_edges(x), (std::array{false, true}));
}

// edges almost sharp: the rectangle up to the outer face less the area under the arc
TEST(Shapes, TireAreaAgainstClosedForm) {
  TireShape tire;
  tire.edge_radius = 1e-5;
  tire.face_facets = 1000;
  const double a = 3.5, rho = 12, under = a * std::sqrt(rho * rho - a * a) + rho * rho * std::asin(a / rho);
  EXPECT_NEAR(signed_area(profile_of(tire, "")), 7 * (12 + 2.75) - under, 1e-4);
}

// Rounded edges meet the faces without a kink: no corner turns more than a facet of an edge does.
TEST(Shapes, TireEdgesAreTangentToItsFaces) {
  TireShape tire;
  tire.edge_facets = 90;
  tire.face_facets = 90;
  const Profile s = profile_of(tire, "");
  for (std::size_t i = 0, n = s.size(); i < n; ++i) {
    const Point2 &a = s[i], &b = s[(i + 1) % n], &c = s[(i + 2) % n];
    const double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {c[0] - b[0], c[1] - b[1]};
    const double angle = std::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
    EXPECT_LT(std::abs(angle), 1.5 * pi / 180);
  }
}

TEST(Shapes, SplinePassesThroughItsCornersSmoothly) {
  Profile corners;
  for (int i = 0; i < 12; ++i) {
    const double t = 2 * pi * (i + .3 * std::sin(i)) / 12;
    corners.push_back({3 * std::cos(t), 12 + 3 * std::sin(t)});
  }
  const Profile s = periodic_spline(corners, 1200);
  EXPECT_NEAR(static_cast<double>(s.size()), 1200, 12);
  for (const Point2& c : corners) EXPECT_TRUE(std::ranges::find(s, c) != s.end());
  for (const Point2& p : s)
    EXPECT_NEAR(std::hypot(p[0], p[1] - 12), 3, 6e-3);  // of the circle that the corners lie on
  double sharpest = 0, flattest = 1;
  for (std::size_t i = 0, n = s.size(); i < n; ++i) {
    const Point2 &a = s[i], &b = s[(i + 1) % n], &c = s[(i + 2) % n];
    const double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {c[0] - b[0], c[1] - b[1]};
    const double curvature = (u[0] * v[1] - u[1] * v[0]) / std::pow(std::hypot(u[0], u[1]), 3);
    sharpest = std::max(sharpest, curvature);
    flattest = std::min(flattest, curvature);
  }
  EXPECT_NEAR(sharpest, 1. / 3, .15);
  EXPECT_NEAR(flattest, 1. / 3, .15);
}

TEST(Shapes, HollowSectionsAreCutIntoEars) {
  const Profile s{{0, 1}, {4, 1}, {4, 3}, {3, 3}, {3, 2},
                  {2, 2}, {1, 2}, {1, 3}, {0, 3}};  // a U with a corner on a straight edge
  double area = 0;
  const auto ears = triangulate(s);
  EXPECT_EQ(ears.size(), s.size() - 2);
  for (const auto& [a, b, c] : ears) {
    EXPECT_GT(signed_area({s[a], s[b], s[c]}), 0);
    area += signed_area({s[a], s[b], s[c]});
  }
  EXPECT_NEAR(area, signed_area(s), 1e-13);
}

TEST(Shapes, WrongSectionsAreRefused) {
  auto reversed = square(1);
  std::ranges::reverse(reversed);
  EXPECT_NE(refusal([&] { body(swept(reversed)); }).find("rigid_bodies.b.swept.section|"), std::string::npos);
  EXPECT_NE(refusal([&] { body(swept(reversed)); }).find("inside out"), std::string::npos);
  EXPECT_NE(refusal([] {
              body(swept({{0, 0}, {3, 2}, {3, 0}, {0, 2}}));
            }).find("crosses itself"),
            std::string::npos);
  EXPECT_NE(refusal([] { body(swept(square(10.5))); }).find("axis"), std::string::npos);
  EXPECT_NE(refusal([] {
              body(swept({{0, 0}, {1, 0}, {1, 0}, {0, 1}}));
            }).find("coincide"),
            std::string::npos);
  EXPECT_NE(refusal([] { body(swept({{0, 0}, {1, 0}})); }).find("encloses nothing"), std::string::npos);
  EXPECT_NE(refusal([] {
              body(swept({{0, 0}, {1, 0, 2}, {1, 1}}));
            }).find("two coordinates"),
            std::string::npos);
  EXPECT_NE(refusal([] { body(swept(square(1), {.from = 90, .to = 0})); }).find("spans"), std::string::npos);
  EXPECT_NE(refusal([] { body({.band = BandShape{.edge_radius = .4}}); }).find("edge_radius"),
            std::string::npos);
  EXPECT_NE(refusal([] { body({.tire = TireShape{.inner_radius_of_curvature = 2}}); }).find("contradict"),
            std::string::npos);
  EXPECT_EQ(refusal([] { body(swept(square(1))); }), "accepted");
}

TEST(Shapes, ExactlyOneShape) {
  EXPECT_NE(refusal([] { body({}); }).find("no shape"), std::string::npos);
  EXPECT_NE(refusal([] { body({.sphere = SphereShape{}, .band = BandShape{}}); }).find("sphere and band"),
            std::string::npos);
}

TEST(Shapes, SurfaceOfAGmshFile) {
  const std::string path = testing::TempDir() + "body_block.msh";
  write_gmsh(generate(BlockShape{.upper = {1, 2, 3}, .nx = 2, .ny = 2, .nz = 2}), path);
  RigidBodySpec spec;
  spec.file = BodyFile{path, "outside", 2};
  const RigidSurface b = body(spec);
  EXPECT_TRUE(is_closed(b));
  EXPECT_NEAR(volume(b), 8 * 6, 1e-12);
  spec.file->surface = "outsid";
  EXPECT_NE(refusal([&] { body(spec); }).find("'outside'"), std::string::npos);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace bulbus
