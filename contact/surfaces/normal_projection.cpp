#include "contact/surfaces/normal_projection.hpp"

#include <algorithm>

namespace bulbus::inline contact {
namespace {

Vec3<double> times(const Vec3<double>& v, const Mat3<double>& M) {
  Vec3<double> r{};
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 3; ++c) r[c] += v[i] * M(i, c);
  return r;
}

// Shares of the force −A φ p ñ: of the carriers their weight, of the corners −L_i.
double share(const ContactColumn& column, const std::array<double, 3>& L) {
  double c = column.carries;
  for (int i = 0; i < 3; ++i) c -= column.corners[i] * L[i];
  return c;
}

}  // namespace

std::optional<NormalProjection> project_along_normals(const Vec3<double>& x, const Pair& flat,
                                                      const Triangle& corners, const CornerNormals& normals,
                                                      const std::array<int, 3>& neighbours) {
  const auto projection = project_along_normals(x, flat, corners, normals);
  if (!projection) return {};
  NormalProjection p{*projection, {}, 1, {}};
  const double length = norm(projection->normal);
  p.pair = {projection->along * length, projection->normal, projection->weights};
  for (double& v : p.pair.normal) v /= length;
  for (int i = 0; i < 3; ++i) {
    const double part = std::max(0., 1 + p.pair.weights[i] / fading_rim);
    if (neighbours[i] >= 0 || part >= 1) continue;
    for (double& v : p.fading) v *= part;
    p.fading[i] += part > 0 ? p.cover / fading_rim : 0;
    p.cover *= part;
  }
  return p;
}

// With z = δx − Σ L_i δx_i − g Σ L_i δn_i:  δL2, δL3, δg by J⁻¹ z,  δn = Σ L_i δn_i + Σ δL_i n_i,  δG = |n|
// δg + g ñ·δn,
//     −δ(A φ p c ñ) = A φ (α δG c ñ − p δc ñ − p c δñ) − A δφ p c ñ
void add_tangent(const NormalProjection& at, const CornerNormals& normals,
                 std::span<const ContactColumn> columns, const ContactStiffness& f, std::span<double> K) {
  const PointOnNormals& projection = at.projection;
  const Vec3<double>& unit = at.pair.normal;
  const auto& L = at.pair.weights;
  const double length = norm(projection.normal), force = f.area * f.pressure;
  const int n = static_cast<int>(columns.size());
  for (int s = 0; s < n; ++s) {
    const ContactColumn& column = columns[s];
    Mat3<double> turn{}, Z{};
    for (int i = 0; i < 3; ++i)
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) turn(r, c) += L[i] * column.turns[i](r, c);
    const double moves = share(column, L);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) Z(r, c) = (r == c ? moves : 0) - projection.along * turn(r, c);
    const Vec3<double> dL2 = times(projection.inverse[0], Z), dL3 = times(projection.inverse[1], Z),
                       dg = times(projection.inverse[2], Z);
    std::array<Vec3<double>, 3> dL{Vec3<double>{}, dL2, dL3};
    for (int c = 0; c < 3; ++c) dL[0][c] = -dL2[c] - dL3[c];
    for (int i = 0; i < 3; ++i)
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) turn(r, c) += normals[i][r] * dL[i][c];
    const Vec3<double> along = times(unit, turn);
    Vec3<double> push;
    for (int c = 0; c < 3; ++c) {
      push[c] = f.area * f.penalty * (length * dg[c] + projection.along * along[c]);
      for (int i = 0; i < 3; ++i) push[c] -= at.cover > 0 ? force / at.cover * at.fading[i] * dL[i][c] : 0;
    }
    for (int r = 0; r < n; ++r) {
      const double c_r = share(columns[r], L);
      for (int i = 0; i < 3; ++i)
        for (int c = 0; c < 3; ++c) {
          double v = c_r * (push[c] * unit[i] - force * (turn(i, c) - unit[i] * along[c]) / length);
          for (int k = 0; k < 3; ++k) v += columns[r].corners[k] * force * dL[k][c] * unit[i];
          K[3 * n * (3 * r + i) + 3 * s + c] += v;
        }
    }
  }
}

}  // namespace bulbus::inline contact
