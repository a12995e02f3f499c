#include "contact/surfaces/rounded_edge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "contact/surfaces/meridians.hpp"

namespace bulbus::inline contact {
namespace {

constexpr double alike = 1e-6;  // relative differences that decide nothing

// The shortest y with n_i·y = q_i on up to three faces and its multipliers: y = Σ l_i n_i.
struct EdgeProjection {
  Vec3<double> y{0, 0, 0};
  std::array<double, 3> l{};
};

Mat3<double> gram(std::span<const FaceGap* const> active) {
  Mat3<double> G{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      G(i, j) =
          i < active.size() && j < active.size() ? dot(active[i]->normal, active[j]->normal) : 1. * (i == j);
  return G;
}

// Symmetric; nothing where normals are alike.
std::optional<Mat3<double>> inverse_gram(std::span<const FaceGap* const> active) {
  const Mat3<double> G = gram(active), cof = cofactor(G);
  const double det = determinant(G, cof);
  if (std::abs(det) < alike) return {};
  Mat3<double> inverse;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) inverse(i, j) = cof(i, j) / det;
  return inverse;
}

std::optional<EdgeProjection> shortest(std::span<const FaceGap* const> active, const Mat3<double>& inverse,
                                       double radius) {
  EdgeProjection f;
  for (std::size_t i = 0; i < active.size(); ++i) {
    for (std::size_t j = 0; j < active.size(); ++j) f.l[i] += inverse(i, j) * (radius + active[j]->gap);
    if (f.l[i] < 0) return {};
    for (int c = 0; c < 3; ++c) f.y[c] += f.l[i] * active[i]->normal[c];
  }
  return f;
}

bool allowed(const Vec3<double>& y, std::span<const FaceGap> faces, double radius) {
  return std::ranges::all_of(
      faces, [&](const FaceGap& f) { return dot(f.normal, y) >= radius + f.gap - alike * radius; });
}

// ∇∇|y| = (P − ŷŷᵀ)/|y| + Σ l_i/|y| ∇∇G_i, P onto the normals in action
FaceGap face_at(const EdgeProjection& projection, std::span<const FaceGap* const> active,
                const Mat3<double>& inverse, double radius) {
  const double length = norm(projection.y);
  FaceGap g{length - radius, (1 / length) * projection.y};
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      double P = 0;
      for (std::size_t i = 0; i < active.size(); ++i) {
        g.bend(r, c) += projection.l[i] / length * active[i]->bend(r, c);
        for (std::size_t j = 0; j < active.size(); ++j)
          P += active[i]->normal[r] * inverse(i, j) * active[j]->normal[c];
      }
      if (active.size() > 1) g.bend(r, c) += (P - g.normal[r] * g.normal[c]) / length;
    }
  return g;
}

FaceGap nearest(std::span<const FaceGap> faces, double radius) {
  FaceGap g = *std::ranges::max_element(faces, {}, &FaceGap::gap);
  Vec3<double> sum{0, 0, 0};
  for (const FaceGap& f : faces)
    if (f.gap > g.gap - alike * radius) sum = sum + f.normal;
  g.normal = (1 / norm(sum)) * sum;
  return g;
}

}  // namespace

FaceGap rounded_gap(std::span<const FaceGap> faces, double radius) {
  const int n = static_cast<int>(faces.size());
  if (n == 1) return faces[0];
  std::vector<const FaceGap*> active;
  const auto found = [&]() -> std::optional<FaceGap> {
    const auto inverse = inverse_gram(active);
    const auto projection = inverse ? shortest(active, *inverse, radius) : std::nullopt;
    if (!projection || !(norm(projection->y) > 0) || !allowed(projection->y, faces, radius)) return {};
    return face_at(*projection, active, *inverse, radius);
  };
  for (int many = 1; many <= 3; ++many)
    for (int i = 0; i < n; ++i)
      for (int j = many > 1 ? i + 1 : n - 1; j < n; ++j)
        for (int k = many > 2 ? j + 1 : n - 1; k < n; ++k) {
          active = {&faces[i]};
          if (many > 1) active.push_back(&faces[j]);
          if (many > 2) active.push_back(&faces[k]);
          if (const auto g = found()) return *g;
        }
  return nearest(faces, radius);
}

}  // namespace bulbus::inline contact
