#include "contact/smooth_normals.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "contact/meridians.hpp"

namespace bulbus {
std::vector<CornerNormals> corner_normals(const Facets& facets, std::span<const double> places, double sharpest) {
  const double least = std::cos(sharpest * std::numbers::pi / 180);
  const auto at = [&](int p) { return Vec3<double>{places[3 * p], places[3 * p + 1], places[3 * p + 2]}; };
  std::vector<Vec3<double>> areas;
  std::vector<std::vector<int>> around(places.size() / 3);
  for (const auto& t : facets.triangles) {
    for (int corner : t) around[corner].push_back(static_cast<int>(areas.size()));
    areas.push_back(cross(minus(at(t[1]), at(t[0])), minus(at(t[2]), at(t[0]))));
  }
  std::vector<CornerNormals> normals(areas.size());
  for (std::size_t k = 0; k < areas.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      Vec3<double> sum{0, 0, 0};
      for (int other : around[facets.triangles[k][i]])
        if (dot(areas[other], areas[k]) >= least * norm(areas[other]) * norm(areas[k]))
          for (int c = 0; c < 3; ++c) sum[c] += areas[other][c];
      normals[k][i] = unit(sum);
    }
  return normals;
}

SmoothNormal smooth_normal(const Pair& p, const CornerNormals& corners) {
  std::array<double, 3> L;
  for (int i = 0; i < 3; ++i) L[i] = std::max(p.weights[i], 0.);
  const double sum = L[0] + L[1] + L[2];
  const auto& [t1, t2] = p.duals;
  const std::array<Vec3<double>, 3> dL{Vec3<double>{-t1[0] - t2[0], -t1[1] - t2[1], -t1[2] - t2[2]}, t1, t2};
  Vec3<double> n{0, 0, 0};
  Mat3<double> dn{};
  for (int i = 0; i < 3; ++i)
    for (int r = 0; r < 3; ++r) {
      n[r] += L[i] / sum * corners[i][r];
      for (int c = 0; c < 3; ++c) dn(r, c) += corners[i][r] * dL[i][c];
    }
  const double length = norm(n);
  for (double& v : n) v /= length;
  if (sum > 1 + 1e-9) return {n, {}};  // beyond an edge the triangle goes on flat
  Mat3<double> across, bend;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) across(r, c) = (r == c) - n[r] * n[c];
  dn = across * dn * across;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) bend(r, c) = (dn(r, c) + dn(c, r)) / (2 * length);
  return {n, bend};
}

}  // namespace bulbus
