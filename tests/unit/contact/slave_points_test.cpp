#include "contact/surfaces/slave_points.hpp"

#include <gtest/gtest.h>

#include "contact/law/contact_term.hpp"
#include "contact/rigid/rigid_shapes.hpp"
#include "tests/support/sheets.hpp"
#include "tests/support/term_tangent.hpp"

namespace bulbus {
namespace {

/// A piece of a sphere of radius 1, 6 × 6 faces, seen from outside.
struct Cap {
  Sheets sheets;
  std::vector<Quad> faces = sheets.add(6, 6, [](double u, double v) {
    const double a = .8 * (u - .5), b = .8 * (v - .5), c = std::sqrt(1 - a * a - b * b);
    return Vec3<double>{a, b, c};
  });
  SlaveSurface surface{sheets.X, sheets.nodes(), faces, {}, {}};
  SlavePoints points{surface, sheets.nodes(), {}, 4};
};

TEST(SlavePoints, ShareOutAllOfTheArea) {
  const Cap cap;
  double points = 0, nodes = 0;
  for (double a : cap.points.shape(cap.sheets.X).areas) points += a;
  for (double a : cap.surface.shape(cap.sheets.X).areas) nodes += a;
  EXPECT_EQ(cap.points.size(), 36 * 16);
  EXPECT_NEAR(points, nodes, 1e-4);
}

TEST(SlavePoints, BulgeToTheSphere) {
  Cap cap;
  cap.points.chordal_offset(cap.sheets.X, cap.faces, {});
  const auto places = cap.points.places(cap.sheets.X);
  const auto normals = cap.points.shape(cap.sheets.X).normals;
  double flat = 0, curved = 0;
  for (int f = 7; f < 29; ++f) {  // the rim's normals are one-sided
    if (f % 6 == 0 || f % 6 == 5) continue;
    for (int i = 16 * f; i < 16 * f + 16; ++i) {
      Vec3<double> x = at(places, i);
      flat = std::max(flat, 1 - norm(x));
      for (int c = 0; c < 3; ++c) x[c] += cap.points[i].chordal_offset * normals[i][c];
      curved = worse(curved, std::abs(1 - norm(x)));
    }
  }
  EXPECT_GT(flat, 3e-3);
  EXPECT_LT(curved, flat / 20);
}

TEST(SlavePoints, DoNotBulgeAcrossSharpEdges) {
  Sheets s;
  const auto faces = s.add(2, 2, [](double u, double v) {
    return Vec3<double>{u, std::min(v, .5), std::min(0., .5 - v)};
  });
  const SlaveSurface surface(s.X, s.nodes(), faces, {}, {});
  SlavePoints points(surface, s.nodes(), {}, 3);
  points.chordal_offset(s.X, faces, {});
  for (int i = 0; i < points.size(); ++i) EXPECT_EQ(points[i].chordal_offset, 0);
}

TEST(SlavePoints, SharesAreTheDerivativeOfThePlace) {
  Cap cap;
  cap.points.chordal_offset(cap.sheets.X, cap.faces, {});
  const Vec3<double> m{.3, -.5, .8};
  const auto along = [&](int i, std::span<const double> x) {
    const auto p = at(cap.points.places(x), i), n = cap.points.shape(x).normals[i];
    return dot(m, p) + cap.points[i].chordal_offset * dot(m, n);
  };
  for (int i : {130, 200, 301}) {
    const auto g = cap.points.shares(i, cap.sheets.X, m);
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 3; ++c) {
        auto up = cap.sheets.X, down = cap.sheets.X;
        up[3 * cap.points[i].nodes[k] + c] += 1e-6, down[3 * cap.points[i].nodes[k] + c] -= 1e-6;
        EXPECT_NEAR((along(i, up) - along(i, down)) / 2e-6, g[k][c], 1e-9);
      }
  }
}

/// Pressed onto a ball from above; a sphere against a sphere.
struct OnABall : testing::Test {
  OnABall() { press(24); }
  void press(int facets) {
    RigidBodySpec spec;
    spec.sphere = SphereShape{.center = {.03, .02, 1.995}, .facets = facets};
    body = std::make_shared<RigidSurface>(make_rigid_surface("ball", spec, "ball"));
  }
  ContactTerm term(int divisions) const {
    ContactSpec spec = contact_spec(20, .2);
    spec.divisions = divisions;
    return ContactTerm(spec, {.penalty = 0, .depth = 0, .reach = .3},
                       {cap.sheets.X, cap.sheets.nodes(), cap.faces, Master(body), {}}, Comm());
  }
  Cap cap;
  std::shared_ptr<RigidSurface> body;
  State state = cap.sheets.state();
};

TEST_F(OnABall, ActionIsTheDerivativeOfTheForce) {
  ContactTerm t = term(4);
  const auto force = [&](std::span<const double> x) {
    std::vector<double> r(x.size());
    t.add_residual({{x.begin(), x.end()}, {}, {}, {}}, r, {});
    return r;
  };
  const auto d = noise_vector(state.x.size(), 3);
  EXPECT_GT(t.figures(state).pairs, 10);
  step_from(state, std::vector<double>(d.size()), t);
  EXPECT_LT(relative_difference(action(t, state, d), derivative(force, state.x, d, 1e-6)),
            2e-3);  // second derivatives of the chordal offset are left out: pressure times chordal offset
}

// The normal of interpolated normals is the gradient of the gap to second order in the angle of a facet.
TEST_F(OnABall, ForceIsThatOfThePotentialToSecondOrderInTheAngleOfItsFacets) {
  const auto d = noise_vector(state.x.size(), 3);
  const auto error = [&](int facets) {
    press(facets);
    const ContactTerm t = term(4);
    std::vector<double> r(state.x.size());
    t.add_residual(state, r, {});
    State up = state, down = state;
    for (std::size_t i = 0; i < d.size(); ++i) up.x[i] += 1e-6 * d[i], down.x[i] -= 1e-6 * d[i];
    return std::abs((t.potential(up) - t.potential(down)) / 2e-6 / inner(r, d) - 1);
  };
  const double coarse = error(24), fine = error(96);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_LT(fine, coarse / 10);
}

TEST_F(OnABall, ForcesAndMomentsBalance) {
  const ContactTerm t = term(4);
  std::vector<double> r(state.x.size());
  t.add_residual(state, r, {});
  Vec3<double> force{}, moment{};
  for (int n = 0; n < cap.sheets.nodes(); ++n) {
    const Vec3<double> f = at(r, n), m = cross(at(state.x, n), f);
    for (int c = 0; c < 3; ++c) force[c] -= f[c], moment[c] -= m[c];
  }
  const Wrench on_body = t.figures(state).on_master[0];
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(force[c], -on_body.force[c], 1e-14);
    EXPECT_NEAR(moment[c], -on_body.moment[c], 1e-14);
  }
}

}  // namespace
}  // namespace bulbus
