#include "core/element/pressure_surface.hpp"

#include "core/base/memory.hpp"
#include "core/element/q1.hpp"

namespace bulbus::inline element {
namespace {

using Corners = std::array<Vec3<Pack>, 4>;

struct FacePoint {
  std::array<double, 4> N, along_xi, along_eta;
};

constexpr std::array<FacePoint, 4> face_points = [] {
  std::array<FacePoint, 4> points{};
  constexpr double s[4] = {-1, 1, 1, -1}, t[4] = {-1, -1, 1, 1};
  constexpr double g = gauss_near - gauss_far;  // 1/√3
  for (int p = 0; p < 4; ++p)
    for (int n = 0; n < 4; ++n) {
      const double a = 1 + g * s[p] * s[n], b = 1 + g * t[p] * t[n];
      points[p].N[n] = a * b / 4;
      points[p].along_xi[n] = s[n] * b / 4;
      points[p].along_eta[n] = t[n] * a / 4;
    }
  return points;
}();

Vec3<Pack> combine(const std::array<double, 4>& weights, const Corners& v) {
  Vec3<Pack> r;
  for (int c = 0; c < 3; ++c)
    r[c] = weights[0] * v[0][c] + weights[1] * v[1][c] + weights[2] * v[2][c] + weights[3] * v[3][c];
  return r;
}

double sum_used(const Pack& v, int used) {
  double sum = 0;
  for (int l = 0; l < used; ++l) sum += v[l];
  return sum;
}

}  // namespace

PressureSurface::PressureSurface(std::span<const Quad> faces)
    : packs_(make_packs<4>(static_cast<int>(faces.size()),
                           [&](int f) {
                             const Quad& q = faces[f];
                             return Quad{q[0], q[3], q[2], q[1]};  // the normal turned into the solid
                           })),
      count_(static_cast<int>(faces.size())) {}

double PressureSurface::volume(std::span<const double> x, const Point& x0) const {
  double V = 0;
  for (const auto& pack : packs_) {
    const Corners v = gather(pack, x);
    Pack sum(0.);
    for (const FacePoint& p : face_points) {
      Vec3<Pack> r = combine(p.N, v);
      for (int c = 0; c < 3; ++c) r[c] -= x0[c];
      sum += dot(r, cross(combine(p.along_xi, v), combine(p.along_eta, v)));
    }
    V += sum_used(sum, pack.used) / 3;
  }
  return V;
}

void PressureSurface::add_gradient(std::span<const double> x, double factor, std::span<double> out) const {
  for (const auto& pack : packs_) {
    const Corners v = gather(pack, x);
    Corners g{};
    for (const FacePoint& p : face_points) {
      const Vec3<Pack> n = cross(combine(p.along_xi, v), combine(p.along_eta, v));
      for (int I = 0; I < 4; ++I)
        for (int c = 0; c < 3; ++c) g[I][c] += factor * p.N[I] * n[c];
    }
    scatter_add(pack, g, out);
  }
}

void PressureSurface::add_stiffness(std::span<const double> x, double factor, std::span<const double> dx,
                                    std::span<double> out) const {
  for (const auto& pack : packs_) {
    const Corners v = gather(pack, x), d = gather(pack, dx);
    Corners f{};
    for (const FacePoint& p : face_points) {
      const Vec3<Pack> one = cross(combine(p.along_xi, d), combine(p.along_eta, v));
      const Vec3<Pack> two = cross(combine(p.along_xi, v), combine(p.along_eta, d));
      for (int I = 0; I < 4; ++I)
        for (int c = 0; c < 3; ++c) f[I][c] += factor * p.N[I] * (one[c] + two[c]);
    }
    scatter_add(pack, f, out);
  }
}

// ∂g_I/∂x_J = Σ N_I (−N_J,ξ [b]× + N_J,η [a]×)
void PressureSurface::visit(std::span<const double> x, double factor,
                            const ContributionVisitor& visitor) const {
  for (const auto& pack : packs_) {
    const Corners v = gather(pack, x);
    std::array<Pack, 144> K{};
    for (const FacePoint& p : face_points) {
      const Vec3<Pack> a = combine(p.along_xi, v), b = combine(p.along_eta, v);
      for (int I = 0; I < 4; ++I)
        for (int J = 0; J < 4; ++J) {
          Vec3<Pack> w;  // the cross matrix of N_J,η a − N_J,ξ b
          for (int c = 0; c < 3; ++c) w[c] = factor * p.N[I] * (p.along_eta[J] * a[c] - p.along_xi[J] * b[c]);
          const auto at = [&](int r, int c) -> Pack& { return K[12 * (3 * I + r) + 3 * J + c]; };
          at(0, 1) -= w[2], at(0, 2) += w[1], at(1, 0) += w[2];
          at(1, 2) -= w[0], at(2, 0) -= w[1], at(2, 1) += w[0];
        }
    }
    for (int l = 0; l < pack.used; ++l) {
      std::array<double, 144> lane;
      std::array<int, 4> nodes;
      for (int i = 0; i < 144; ++i) lane[i] = K[i][l];
      for (int i = 0; i < 4; ++i) nodes[i] = pack.node[i][l];
      visitor(nodes, lane);
    }
  }
}

std::size_t PressureSurface::bytes() const { return bytes_of(packs_); }

}  // namespace bulbus::inline element
