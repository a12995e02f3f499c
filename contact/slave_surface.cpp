#include "contact/slave_surface.hpp"

#include <algorithm>
#include <map>

#include "core/element/q1.hpp"

namespace bulbus {
namespace {


// The tangents at the Gauss point next to corner p of a face, a = ∂x/∂ξ and b = ∂x/∂η as seen along the two edges from there.
struct FaceTangents {
  std::array<double, 4> da{}, db{};  // shares of the corners
  Vec3<double> a{}, b{};
};
FaceTangents face_tangents(std::span<const double> x, const Quad& q, int p) {
  FaceTangents t;
  const int next = (p + 1) % 4, opposite = (p + 2) % 4, before = (p + 3) % 4;
  t.da[next] = t.db[before] = gauss_near / 2;
  t.da[p] = t.db[p] = -gauss_near / 2;
  t.da[opposite] = t.db[opposite] = gauss_far / 2;
  t.da[before] = t.db[next] = -gauss_far / 2;
  for (int j = 0; j < 4; ++j)
    for (int c = 0; c < 3; ++c) {
      t.a[c] += t.da[j] * x[3 * q[j] + c];
      t.b[c] += t.db[j] * x[3 * q[j] + c];
    }
  return t;
}

// Shape function of a corner at the Gauss point next to corner p.
double at_gauss_point(int corner, int p) {
  if (corner == p) return gauss_near * gauss_near;
  return corner == (p + 2) % 4 ? gauss_far * gauss_far : gauss_near * gauss_far;
}

}  // namespace

std::vector<std::array<bool, 3>> mirrored(std::span<const double> X, std::span<const int> nodes, std::span<const std::string> symmetry) {
  double size = 0;
  for (int n : nodes)
    for (int c = 0; c < 3; ++c) size = std::max(size, std::abs(X[3 * n + c]));
  std::vector<std::array<bool, 3>> flat(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::string& plane : symmetry) flat[i][plane[0] - 'x'] = std::abs(X[3 * nodes[i] + plane[0] - 'x']) <= 1e-9 * size;
  return flat;
}

SlaveSurface::SlaveSurface(std::span<const double> X, int owned, std::span<const Quad> faces, std::span<const int> excluded,
                           std::span<const std::string> symmetry) {
  for (const Quad& q : faces)
    for (int n : q)
      if (n < owned) nodes_.push_back(n);
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  std::erase_if(nodes_, [&](int n) { return std::ranges::binary_search(excluded, n); });
  std::map<int, int> index;
  for (int n : nodes_) index.insert({n, static_cast<int>(index.size())});
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Quad& q = faces[f];
    std::array<int, 4> at;
    for (int i = 0; i < 4; ++i) at[i] = index.contains(q[i]) ? index[q[i]] : -1;
    if (std::ranges::all_of(at, [](int i) { return i < 0; })) continue;
    faces_.push_back(q);
    numbers_.push_back(static_cast<int>(f));
    corners_.push_back(at);
  }
  mirrored_ = mirrored(X, nodes_, symmetry);
}

SlaveSurface::Shape SlaveSurface::shape(std::span<const double> x) const {
  Shape s{std::vector<Vec3<double>>(nodes_.size()), std::vector<double>(nodes_.size())};
  for (std::size_t f = 0; f < faces_.size(); ++f)
    for (int p = 0; p < 4; ++p) {
      const FaceTangents t = face_tangents(x, faces_[f], p);
      const Vec3<double> normal = cross(t.a, t.b);
      const double area = norm(normal);
      for (int k = 0; k < 4; ++k)
        if (const int at = corners_[f][k]; at >= 0) {
          const double N = at_gauss_point(k, p);
          for (int c = 0; c < 3; ++c) s.normals[at][c] += N * normal[c];
          s.areas[at] += N * area;
        }
    }
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Vec3<double>& n = s.normals[i];
    for (int c = 0; c < 3; ++c)
      if (mirrored_[i][c]) n[c] = 0;
    const double length = norm(n);
    for (double& v : n) v = length > 1e-9 * s.areas[i] ? v / length : 0;
  }
  return s;
}

NormalShare normal_share(int node, const Vec3<double>& s, const Vec3<double>& m, const std::array<bool, 3>& mirrored) {
  Mat3<double> cross_s{};
  cross_s(0, 1) = -s[2], cross_s(0, 2) = s[1], cross_s(1, 0) = s[2], cross_s(1, 2) = -s[0], cross_s(2, 0) = -s[1], cross_s(2, 1) = s[0];
  NormalShare share{node, {}};
  const double length = norm(m);
  if (length == 0) return share;
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k) {
      const double Q = mirrored[k] ? 0 : ((r == k) - m[r] / length * m[k] / length) / length;
      for (int c = 0; c < 3; ++c) share.turn(r, c) += Q * cross_s(k, c);
    }
  return share;
}

}  // namespace bulbus
