#include "contact/surfaces/slave_surface.hpp"

#include <algorithm>
#include <map>

#include "core/base/sort_unique.hpp"
#include "core/element/q1.hpp"

namespace bulbus::inline contact {
std::vector<std::array<bool, 3>> mirrored(std::span<const double> X, std::span<const int> nodes,
                                          std::span<const std::string> symmetry) {
  double size = 0;
  for (int n : nodes)
    for (int c = 0; c < 3; ++c) size = std::max(size, std::abs(X[3 * n + c]));
  std::vector<std::array<bool, 3>> flat(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const std::string& plane : symmetry)
      flat[i][plane[0] - 'x'] = std::abs(X[3 * nodes[i] + plane[0] - 'x']) <= 1e-9 * size;
  return flat;
}

SlaveSurface::SlaveSurface(std::span<const double> X, int owned, std::span<const Quad> faces,
                           std::span<const int> excluded, std::span<const std::string> symmetry) {
  for (const Quad& q : faces)
    for (int n : q)
      if (n < owned) nodes_.push_back(n);
  sort_unique(nodes_);
  std::erase_if(nodes_, [&](int n) { return std::ranges::binary_search(excluded, n); });
  std::map<int, int> index;
  for (int n : nodes_) index.insert({n, static_cast<int>(index.size())});
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Quad& q = faces[f];
    std::array<int, 4> at;
    for (int i = 0; i < 4; ++i) at[i] = index.contains(q[i]) ? index[q[i]] : -1;
    if (std::ranges::all_of(q, [&](int n) { return n >= owned; })) continue;
    faces_.push_back(q);
    numbers_.push_back(static_cast<int>(f));
    corners_.push_back(at);
  }
  mirrored_ = mirrored(X, nodes_, symmetry);
}

SlaveSurface::Shape SlaveSurface::shape(std::span<const double> x) const {
  Shape s{std::vector<Vec3<double>>(nodes_.size()), std::vector<double>(nodes_.size())};
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    std::array<Vec3<double>, 4> v;
    for (int i = 0; i < 4; ++i) v[i] = at(x, faces_[f][i]);
    for (int p = 0; p < 4; ++p) {  // the Gauss point next to corner p, seen along the two edges from there
      const int next = (p + 1) % 4, opposite = (p + 2) % 4, before = (p + 3) % 4;
      Vec3<double> a, b;
      for (int c = 0; c < 3; ++c) {
        a[c] = (gauss_near * (v[next][c] - v[p][c]) + gauss_far * (v[opposite][c] - v[before][c])) / 2;
        b[c] = (gauss_near * (v[before][c] - v[p][c]) + gauss_far * (v[opposite][c] - v[next][c])) / 2;
      }
      const Vec3<double> normal = cross(a, b);
      const double area = norm(normal);
      for (const auto& [corner, N] : {std::pair{p, gauss_near * gauss_near},
                                      {next, gauss_near * gauss_far},
                                      {opposite, gauss_far * gauss_far},
                                      {before, gauss_near * gauss_far}})
        if (const int at = corners_[f][corner]; at >= 0) {
          for (int c = 0; c < 3; ++c) s.normals[at][c] += N * normal[c];
          s.areas[at] += N * area;
        }
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

}  // namespace bulbus::inline contact
