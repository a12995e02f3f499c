#include "contact/surfaces/master_normals.hpp"

#include <algorithm>

namespace bulbus::inline contact {
namespace {

Vec3<double> diagonal(std::span<const double> x, int from, int to) { return minus(at(x, to), at(x, from)); }

// δN = (1 − N Nᵀ) M (s × δx) / |m| of the unit normal N = m/|m| with δm = M (s × δx); M drops the components
// that are `mirrored`.
Mat3<double> turn_of_unit(const Vec3<double>& s, const Vec3<double>& m, const std::array<bool, 3>& mirrored) {
  Mat3<double> turn{};
  const double length = norm(m);
  if (length == 0) return turn;
  const Mat3<double> cross_s{{{{0, -s[2], s[1]}, {s[2], 0, -s[0]}, {-s[1], s[0], 0}}}};
  for (int r = 0; r < 3; ++r)
    for (int k = 0; k < 3; ++k) {
      const double Q = mirrored[k] ? 0 : ((r == k) - m[r] / length * m[k] / length) / length;
      for (int c = 0; c < 3; ++c) turn(r, c) += Q * cross_s(k, c);
    }
  return turn;
}

}  // namespace

MasterNormals::MasterNormals(const Facets& facets, std::vector<std::array<bool, 3>> mirrored)
    : triangles_(facets.triangles), around_(mirrored.size()), mirrored_(std::move(mirrored)) {
  for (std::size_t t = 0; t + 1 < triangles_.size(); t += 2) {
    const Quad q{triangles_[t][0], triangles_[t][1], triangles_[t][2], triangles_[t + 1][2]};
    for (int n : q) around_[n].push_back(static_cast<int>(faces_.size()));
    faces_.push_back(q);
  }
}

Vec3<double> MasterNormals::sum(int node, std::span<const double> x) const {
  Vec3<double> m{};
  for (int f : around_[node]) {
    const Quad& q = faces_[f];
    const Vec3<double> area = cross(diagonal(x, q[0], q[2]), diagonal(x, q[1], q[3]));
    for (int c = 0; c < 3; ++c) m[c] += mirrored_[node][c] ? 0 : area[c] / 2;
  }
  return m;
}

std::vector<CornerNormals> MasterNormals::at_corners(std::span<const double> x) const {
  std::vector<Vec3<double>> normals;
  for (int n = 0; n < static_cast<int>(around_.size()); ++n) {
    Vec3<double> m = sum(n, x);
    const double length = norm(m);
    for (double& v : m) v = length > 0 ? v / length : 0;
    normals.push_back(m);
  }
  std::vector<CornerNormals> corners;
  for (const auto& t : triangles_) corners.push_back({normals[t[0]], normals[t[1]], normals[t[2]]});
  return corners;
}

// With d = x2 − x0 and e = x3 − x1:  δ(½ d×e) = Σ s_j × δx_j,  s_0 = ½ e, s_2 = −½ e, s_3 = ½ d, s_1 = −½ d
std::vector<NormalShare> MasterNormals::turning(int node, std::span<const double> x) const {
  std::vector<std::pair<int, Vec3<double>>> sums;
  const auto add = [&](int other, double factor, const Vec3<double>& d) {
    auto at = std::ranges::find(sums, other, &std::pair<int, Vec3<double>>::first);
    if (at == sums.end()) at = sums.insert(at, {other, {}});
    for (int c = 0; c < 3; ++c) at->second[c] += factor * d[c];
  };
  for (int f : around_[node]) {
    const Quad& q = faces_[f];
    const Vec3<double> d = diagonal(x, q[0], q[2]), e = diagonal(x, q[1], q[3]);
    add(q[0], .5, e), add(q[1], -.5, d), add(q[2], -.5, e), add(q[3], .5, d);
  }
  const Vec3<double> m = sum(node, x);
  std::vector<NormalShare> shares;
  for (const auto& [other, s] : sums) shares.push_back({other, turn_of_unit(s, m, mirrored_[node])});
  return shares;
}

}  // namespace bulbus::inline contact
