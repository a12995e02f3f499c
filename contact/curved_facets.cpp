#include "contact/curved_facets.hpp"

#include <algorithm>
#include <cmath>

#include "contact/meridians.hpp"

namespace bulbus {
std::vector<CornerNormals> corner_normals(const Facets& facets, std::span<const double> places) {
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
        if (dot(areas[other], areas[k]) >= smooth_edge * norm(areas[other]) * norm(areas[k]))
          for (int c = 0; c < 3; ++c) sum[c] += areas[other][c];
      normals[k][i] = unit(sum);
    }
  return normals;
}

// |Σ s_ij L_i L_j| ≤ max |s_ij| · ⅓ on the triangle; feet up to a triangle's size beside it count thrice
double rise(const Facets& facets, std::span<const double> places, std::span<const CornerNormals> normals) {
  const auto at = [&](int p) { return Vec3<double>{places[3 * p], places[3 * p + 1], places[3 * p + 2]}; };
  double most = 0;
  for (std::size_t k = 0; k < normals.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const auto& t = facets.triangles[k];
      most = std::max(most, std::abs(dot(minus(normals[k][i], normals[k][j]), minus(at(t[i]), at(t[j])))) / 2);
    }
  return most;
}

CurvedGap curved_gap(const Pair& p, const Triangle& x, const CornerNormals& n) {
  CurvedGap g{p.gap, p.normal, {}};
  if (std::ranges::min(p.weights) < -1) return g;
  const auto& [t1, t2] = p.duals;
  const std::array<Vec3<double>, 3> dL{Vec3<double>{-t1[0] - t2[0], -t1[1] - t2[1], -t1[2] - t2[2]}, t1, t2};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double s = dot(minus(n[i], n[j]), minus(x[i], x[j])) / 2;
    g.gap -= s * p.weights[i] * p.weights[j];
    for (int r = 0; r < 3; ++r) {
      g.gradient[r] -= s * (p.weights[i] * dL[j][r] + p.weights[j] * dL[i][r]);
      for (int c = 0; c < 3; ++c) g.bend(r, c) -= s * (dL[i][r] * dL[j][c] + dL[j][r] * dL[i][c]);
    }
  }
  return g;
}

}  // namespace bulbus
