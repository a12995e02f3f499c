#include "contact/surfaces/smoothed_facets.hpp"

#include <algorithm>
#include <cmath>

#include "contact/surfaces/meridians.hpp"

namespace bulbus::inline contact {
namespace {

constexpr int most_steps = 12;  // of Newton's method, whose error squares with each

}  // namespace

std::vector<CornerNormals> corner_normals(const Facets& facets, std::span<const double> places) {
  struct Share {
    int triangle;
    double angle;
  };
  std::vector<Vec3<double>> areas;
  std::vector<std::vector<Share>> around(places.size() / 3);
  for (int t = 0; t < static_cast<int>(facets.triangles.size()); ++t) {
    const Triangle v = corners_of(facets, places, t);
    for (int i = 0; i < 3; ++i) around[facets.triangles[t][i]].push_back({t, angle_at(v, i)});
    areas.push_back(cross(minus(v[1], v[0]), minus(v[2], v[0])));
  }
  std::vector<CornerNormals> normals(areas.size());
  for (std::size_t k = 0; k < areas.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      Vec3<double> sum{0, 0, 0};
      for (const auto& [other, angle] : around[facets.triangles[k][i]])
        if (dot(areas[other], areas[k]) >= smooth_edge * norm(areas[other]) * norm(areas[k]))
          sum = sum + angle * areas[other];
      normals[k][i] = unit(sum);
    }
  return normals;
}

// |Σ s_ij L_i L_j| ≤ max |s_ij| · ⅓ on the triangle; feet up to a triangle's size beside it count thrice
double rise(const Facets& facets, std::span<const double> places, std::span<const CornerNormals> normals) {
  double most = 0;
  for (std::size_t k = 0; k < normals.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      const auto& t = facets.triangles[k];
      most = std::max(
          most,
          std::abs(dot(minus(normals[k][i], normals[k][j]), minus(at(places, t[i]), at(places, t[j])))) / 2);
    }
  return most;
}

// Newton's method for x = x1 + L2 e2 + L3 e3 + g (n1 + L2 d2 + L3 d3) with d_i = n_i − n1
std::optional<PointOnNormals> project_along_normals(const Vec3<double>& x, const Pair& flat,
                                                    const Triangle& v, const CornerNormals& n) {
  if (std::ranges::min(flat.weights) < -1) return {};
  const Vec3<double> e2 = minus(v[1], v[0]), e3 = minus(v[2], v[0]), d2 = minus(n[1], n[0]),
                     d3 = minus(n[2], n[0]);
  double L2 = flat.weights[1], L3 = flat.weights[2], change = 1;
  PointOnNormals projection{.along = flat.gap};
  for (int step = 0; step < most_steps && change > 1e-14; ++step) {
    Vec3<double> a, b, rest;
    for (int c = 0; c < 3; ++c) {
      a[c] = e2[c] + projection.along * d2[c], b[c] = e3[c] + projection.along * d3[c];
      projection.normal[c] = n[0][c] + L2 * d2[c] + L3 * d3[c];
      rest[c] = x[c] - v[0][c] - L2 * e2[c] - L3 * e3[c] - projection.along * projection.normal[c];
    }
    projection.inverse = {cross(b, projection.normal), cross(projection.normal, a), cross(a, b)};
    const double det = dot(a, projection.inverse[0]);
    for (Vec3<double>& row : projection.inverse)
      for (double& value : row) value /= det;
    const double dL2 = dot(projection.inverse[0], rest), dL3 = dot(projection.inverse[1], rest);
    L2 += dL2, L3 += dL3, projection.along += dot(projection.inverse[2], rest);
    change = std::abs(dL2) + std::abs(dL3);
  }
  if (!(change < 1e-9)) return {};
  projection.weights = {1 - L2 - L3, L2, L3};
  for (int c = 0; c < 3; ++c) projection.normal[c] = n[0][c] + L2 * d2[c] + L3 * d3[c];
  return projection;
}

// The normal's change is (d2 (J⁻¹)_1 + d3 (J⁻¹)_2) δx.
FaceGap smoothed_gap(const Vec3<double>& x, const Pair& flat, const Triangle& v, const CornerNormals& n) {
  const auto projection = project_along_normals(x, flat, v, n);
  if (!projection) return {flat.gap, flat.normal};
  const double length = norm(projection->normal);
  const auto& L = projection->weights;
  FaceGap curved{projection->along * length, projection->normal};
  for (double& value : curved.normal) value /= length;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    curved.gap -= dot(minus(n[i], n[j]), minus(v[i], v[j])) / 2 * L[i] * L[j];
  }
  const Vec3<double>& m = curved.normal;
  const Vec3<double> d2 = minus(n[1], n[0]), d3 = minus(n[2], n[0]);
  const double along2 = dot(m, d2), along3 = dot(m, d3);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const double turn = ((d2[r] - along2 * m[r]) * projection->inverse[0][c] +
                           (d3[r] - along3 * m[r]) * projection->inverse[1][c]) /
                          length;
      curved.bend(r, c) += turn / 2;
      curved.bend(c, r) += turn / 2;
    }
  return curved;
}

}  // namespace bulbus::inline contact
