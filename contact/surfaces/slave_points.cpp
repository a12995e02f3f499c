#include "contact/surfaces/slave_points.hpp"

#include <algorithm>
#include <map>

#include "contact/surfaces/smoothed_facets.hpp"

namespace bulbus::inline contact {
namespace {

// Corners of the reference square, counter-clockwise.
constexpr double corner_xi[4] = {-1, 1, 1, -1}, corner_eta[4] = {-1, -1, 1, 1};

double midpoint(int part, int parts) { return (2. * part + 1) / parts - 1; }

}  // namespace

SlavePoints::SlavePoints(const SlaveSurface& surface, int owned, std::span<const int> excluded, int divisions)
    : divisions_(divisions) {
  if (divisions == 0)
    for (int n : surface.nodes()) points_.push_back({{n}, {1}, 1, true, 0});
  for (const Quad& q : divisions > 0 ? surface.faces() : std::span<const Quad>{}) {
    if (std::ranges::any_of(q, [&](int n) { return std::ranges::binary_search(excluded, n); })) continue;
    for (int j = 0; j < divisions; ++j)
      for (int i = 0; i < divisions; ++i) {
        Point p{{q[0], q[1], q[2], q[3]}, {}, 4, q[0] < owned, 0};
        for (int k = 0; k < 4; ++k)
          p.weights[k] =
              (1 + corner_xi[k] * midpoint(i, divisions)) * (1 + corner_eta[k] * midpoint(j, divisions)) / 4;
        points_.push_back(p);
      }
  }
}

std::vector<long long> SlavePoints::keys(const SlaveSurface& surface) const {
  std::map<int, long long> of_node;  // its first corner
  std::map<Quad, long long> of_face;
  for (std::size_t f = 0; f < surface.faces().size(); ++f) {
    const Quad& q = surface.faces()[f];
    const long long number = surface.numbers()[f];
    of_face.emplace(q, number * divisions_ * divisions_);
    for (int k = 0; k < 4; ++k) of_node.emplace(q[k], 4 * number + k);
  }
  std::vector<long long> keys;
  for (const Point& p : points_) keys.push_back(on_faces() ? of_face.at(p.nodes)++ : of_node.at(p.nodes[0]));
  return keys;
}

void SlavePoints::chordal_offset(std::span<const double> X, std::span<const Quad> all,
                                 std::span<const std::string> symmetry) {
  if (!on_faces()) return;
  const SlaveSurface whole(X, static_cast<int>(X.size() / 3), all, {}, symmetry);
  const auto normals = whole.shape(X).normals, own = shape(X).normals;
  const auto at = places(X);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    Point& p = points_[i];
    bool smooth = true;
    for (int k = 0; k < 4; ++k) {
      const Vec3<double>& n =
          normals[std::ranges::lower_bound(whole.nodes(), p.nodes[k]) - whole.nodes().begin()];
      smooth = smooth && dot(n, own[i]) > smooth_edge;
      for (int c = 0; c < 3; ++c)
        p.chordal_offset += p.weights[k] * n[c] * (X[3 * p.nodes[k] + c] - at[3 * i + c]) / 2;
    }
    if (!smooth) p.chordal_offset = 0;
  }
}

std::vector<double> SlavePoints::places(std::span<const double> x) const {
  std::vector<double> places(3 * points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i)
    for (int k = 0; k < points_[i].carriers; ++k)
      for (int c = 0; c < 3; ++c) places[3 * i + c] += points_[i].weights[k] * x[3 * points_[i].nodes[k] + c];
  return places;
}

SlavePoints::Tangents SlavePoints::tangents(const Point& p, std::span<const double> x) const {
  Tangents t{};
  for (int k = 0; k < 4; ++k) {
    t.xi[k] = corner_xi[k] * (p.weights[k ^ 1] + p.weights[k]) / 2;
    t.eta[k] = corner_eta[k] * (p.weights[3 - k] + p.weights[k]) / 2;
    for (int c = 0; c < 3; ++c) {
      t.a[c] += t.xi[k] * x[3 * p.nodes[k] + c];
      t.b[c] += t.eta[k] * x[3 * p.nodes[k] + c];
    }
  }
  return t;
}

SlaveSurface::Shape SlavePoints::shape(std::span<const double> x) const {
  SlaveSurface::Shape s;
  for (const Point& p : points_) {
    const Tangents t = tangents(p, x);
    Vec3<double> n = cross(t.a, t.b);
    const double area = norm(n);
    for (double& v : n) v = area > 0 ? v / area : 0;
    s.normals.push_back(n);
    s.areas.push_back(area * 4 / (divisions_ * divisions_));
  }
  return s;
}

// With N = a×b/j and m⊥ = m − (m·N) N:  m·δN = (δa·(b×m⊥) + δb·(m⊥×a)) / j
std::array<Vec3<double>, 4> SlavePoints::shares(int i, std::span<const double> x,
                                                const Vec3<double>& m) const {
  const Point& p = points_[i];
  std::array<Vec3<double>, 4> g;
  for (int k = 0; k < 4; ++k)
    for (int c = 0; c < 3; ++c) g[k][c] = p.weights[k] * m[c];
  if (p.chordal_offset == 0) return g;
  const Tangents t = tangents(p, x);
  const Vec3<double> n = cross(t.a, t.b);
  const double j = norm(n), along = dot(m, n) / (j * j);
  const Vec3<double> across{m[0] - along * n[0], m[1] - along * n[1], m[2] - along * n[2]};
  const Vec3<double> u = cross(t.b, across), v = cross(across, t.a);
  for (int k = 0; k < 4; ++k)
    for (int c = 0; c < 3; ++c) g[k][c] += p.chordal_offset / j * (t.xi[k] * u[c] + t.eta[k] * v[c]);
  return g;
}

}  // namespace bulbus::inline contact
