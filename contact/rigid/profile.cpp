#include "contact/rigid/profile.hpp"

#include "core/base/error.hpp"

#include <Eigen/Sparse>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace bulbus::inline contact {
namespace {

constexpr std::size_t most_corners = 20000;  // each edge is compared with each

double distance(const Point2& a, const Point2& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

bool cross_each_other(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

// Points from angle `from` to `to` (radians), both ends included.
void add_circle(Profile& profile, const Point2& center, double radius, double from, double to, int facets) {
  for (int i = 0; i <= facets; ++i) {
    const double angle = from + (to - from) * i / facets;
    profile.push_back({center[0] + radius * std::cos(angle), center[1] + radius * std::sin(angle)});
  }
}

// Measures of the profile that band and tire share.
struct BuckleSize {
  double width, height, edge, radius, axial;
  int edge_facets;
};

// `lift`: the radial place of the centres of the inner edges; `tilt`: half the opening of the inner face,
// seen from its centre of curvature. From the left inner edge over the right one outwards and back; `inner`
// adds the points between the inner edges.
template <class Inner>
Profile buckle(const BuckleSize& p, double lift, double tilt, Inner inner) {
  constexpr double right = std::numbers::pi / 2;
  const double a = p.width / 2 - p.edge, top = p.radius + p.height - p.edge;
  Profile s;
  add_circle(s, {p.axial - a, lift}, p.edge, 2 * right, 3 * right + tilt, p.edge_facets);
  inner(s);
  add_circle(s, {p.axial + a, lift}, p.edge, 3 * right - tilt, 4 * right, p.edge_facets);
  add_circle(s, {p.axial + a, top}, p.edge, 0, right, p.edge_facets);
  add_circle(s, {p.axial - a, top}, p.edge, right, 2 * right, p.edge_facets);
  return s;
}

// Second derivatives of the closed cubic spline at its knots:
// h₋/6 M₋ + (h₋ + h)/3 M + h/6 M₊ = (y₊ − y)/h − (y − y₋)/h₋
Eigen::MatrixX2d spline_curvatures(const Profile& y, const std::vector<double>& h) {
  const int n = static_cast<int>(y.size());
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d b(n, 2);
  for (int i = 0; i < n; ++i) {
    const int before = (i + n - 1) % n, after = (i + 1) % n;
    entries.emplace_back(i, before, h[before] / 6);
    entries.emplace_back(i, i, (h[before] + h[i]) / 3);
    entries.emplace_back(i, after, h[i] / 6);
    for (int c = 0; c < 2; ++c)
      b(i, c) = (y[after][c] - y[i][c]) / h[i] - (y[i][c] - y[before][c]) / h[before];
  }
  Eigen::SparseMatrix<double> A(n, n);  // symmetric, its diagonal dominates
  A.setFromTriplets(entries.begin(), entries.end());
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(A).solve(b);
}

}  // namespace

double signed_area(const Profile& s) {
  double twice = 0;
  for (std::size_t i = 0; i < s.size(); ++i) twice += turn({0, 0}, s[i], s[(i + 1) % s.size()]);
  return twice / 2;
}

void require_profile(const Profile& s, const std::string& key) {
  const std::size_t n = s.size();
  if (n < 3)
    throw scene_error(key, "a section of " + std::to_string(n) + " corners encloses nothing",
                      "Give at least three.");
  if (n > most_corners)
    throw scene_error(key,
                      "a section of " + std::to_string(n) +
                          " corners is finer than any contact feels: at most " + std::to_string(most_corners),
                      "Leave corners out; `spline` joins a few of them smoothly.");
  double length = 0;
  for (std::size_t i = 0; i < n; ++i) length += distance(s[i], s[(i + 1) % n]);
  for (std::size_t i = 0; i < n; ++i) {
    if (!(distance(s[i], s[(i + 1) % n]) > 1e-9 * length))
      throw scene_error(
          key,
          "corners " + std::to_string(i) + " and " + std::to_string((i + 1) % n) + " of the section coincide",
          "Give every corner once; the section closes by itself.");
    if (!(s[i][1] > 0))
      throw scene_error(
          key, "the section reaches the axis: a corner has a radius of " + std::to_string(s[i][1]) + " mm",
          "Place it at radii above 0.");
    for (std::size_t j = i + 2; j < n; ++j)
      if ((j + 1) % n != i && cross_each_other(s[i], s[i + 1], s[j], s[(j + 1) % n]))
        throw scene_error(key,
                          "the section crosses itself: its edges " + std::to_string(i) + " and " +
                              std::to_string(j) + " meet",
                          "Give the corners in their order around the section.");
  }
  if (!(signed_area(s) > 0))
    throw scene_error(key, "the section is inside out",
                      "List its corners in the opposite order: counter-clockwise with the axis to the right "
                      "and the radius up.");
}

Profile periodic_spline(const Profile& corners, int points) {
  const int n = static_cast<int>(corners.size());
  std::vector<double> h(n);
  for (int i = 0; i < n; ++i) h[i] = distance(corners[i], corners[(i + 1) % n]);
  const double length = std::accumulate(h.begin(), h.end(), 0.);
  const Eigen::MatrixX2d M = spline_curvatures(corners, h);
  Profile s;
  for (int i = 0; i < n; ++i) {
    const int pieces = std::max(1, static_cast<int>(std::lround(points * h[i] / length))),
              after = (i + 1) % n;
    for (int k = 0; k < pieces; ++k) {
      const double v = static_cast<double>(k) / pieces, u = 1 - v;
      Point2 p;
      for (int c = 0; c < 2; ++c)
        p[c] = u * corners[i][c] + v * corners[after][c] +
               h[i] * h[i] / 6 * ((u * u * u - u) * M(i, c) + (v * v * v - v) * M(after, c));
      s.push_back(p);
    }
  }
  return s;
}

std::vector<std::array<int, 3>> triangulate(const Profile& s) {
  std::vector<int> rest(s.size());
  std::iota(rest.begin(), rest.end(), 0);
  std::vector<std::array<int, 3>> triangles;
  const auto is_ear = [&](int a, int b, int c) {
    if (!(turn(s[a], s[b], s[c]) > 0)) return false;
    return std::ranges::none_of(rest, [&](int p) {
      return p != a && p != b && p != c && turn(s[a], s[b], s[p]) >= 0 && turn(s[b], s[c], s[p]) >= 0 &&
             turn(s[c], s[a], s[p]) >= 0;
    });
  };
  while (rest.size() > 2) {
    const int n = static_cast<int>(rest.size());
    int tip = 0;
    while (tip < n && !is_ear(rest[(tip + n - 1) % n], rest[tip], rest[(tip + 1) % n])) ++tip;
    if (tip == n)
      throw input_error("a section cannot be cut into triangles",
                        "Give a polygon that does not touch itself.");
    triangles.push_back({rest[(tip + n - 1) % n], rest[tip], rest[(tip + 1) % n]});
    rest.erase(rest.begin() + tip);
  }
  return triangles;
}

Profile profile_of(const SweptShape& shape, const std::string& key) {
  if (shape.at.size() != 2)
    throw scene_error(key + ".at", "a point in the meridian plane has two coordinates",
                      "Write [axial, radial].");
  if (!shape.spline && shape.points != SweptShape{}.points)
    throw scene_error(key + ".points", "has no effect: `spline` is false",
                      "Add `spline: true`, or leave it out.");
  Profile s;
  for (const auto& corner : shape.section) {
    if (corner.size() != 2)
      throw scene_error(key + ".section", "a corner of the section has two coordinates",
                        "Write [axial, radial] for each.");
    s.push_back({shape.at[0] + corner[0], shape.at[1] + corner[1]});
  }
  require_profile(s, key + ".section");
  if (shape.spline) {
    s = periodic_spline(s, shape.points);
    require_profile(s, key + ".section");
  }
  return s;
}

Profile profile_of(const BandShape& b, const std::string& key) {
  if (2 * b.edge_radius >= std::min(b.width, b.thickness))
    throw scene_error(key + ".edge_radius", "the rounded edges do not fit into the band",
                      "Keep edge_radius below half its width and half its thickness.");
  const BuckleSize p{b.width, b.thickness, b.edge_radius, b.radius, b.axial, b.edge_facets};
  return buckle(p, b.radius + b.edge_radius, 0, [](Profile&) {});
}

Profile profile_of(const TireShape& t, const std::string& key) {
  // circles of the inner edges touch the inner face from outside: their centres are at rho + edge from its
  // centre of curvature
  const double rho = t.inner_radius_of_curvature, base = t.radius - rho, reach = rho + t.edge_radius,
               a = t.width / 2 - t.edge_radius;
  const double lift = base + std::sqrt(std::max(0., reach * reach - a * a));
  if (!(a > 0) || !(a < reach) || !(lift < t.radius + t.crown - t.edge_radius))
    throw scene_error(
        key, "width, crown, edge_radius and inner_radius_of_curvature of the tire contradict each other",
        "Keep edge_radius below half the width and half the crown, the width below twice "
        "inner_radius_of_curvature.");
  const double tilt = std::asin(a / reach);
  const BuckleSize p{t.width, t.crown, t.edge_radius, t.radius, t.axial, t.edge_facets};
  return buckle(p, lift, tilt, [&](Profile& s) {
    constexpr double up = std::numbers::pi / 2;
    Profile face;
    add_circle(face, {t.axial, base}, rho, up + tilt, up - tilt, t.face_facets);
    s.insert(s.end(), face.begin() + 1, face.end() - 1);  // its ends are those of the edges
  });
}

BandShape made_smaller(BandShape b, double inset) {
  b.edge_radius -= inset;
  b.width -= 2 * inset;
  b.thickness -= 2 * inset;
  b.radius += inset;
  return b;
}

TireShape made_smaller(TireShape t, double inset) {
  t.edge_radius -= inset;
  t.width -= 2 * inset;
  t.crown -= 2 * inset;
  t.radius += inset;
  t.inner_radius_of_curvature += inset;
  return t;
}

}  // namespace bulbus::inline contact
