#include "core/mesh/geometry.hpp"

#include <algorithm>

namespace bulbus::inline mesh {
namespace {

constexpr std::array<std::array<int, 3>, 8> signs{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
const double gauss = 1 / std::sqrt(3.0);  // 2-point rule: exact to degree 3 per direction

std::array<double, 4> bilinear(double xi, double eta) {
  return {.25 * (1 - xi) * (1 - eta), .25 * (1 + xi) * (1 - eta), .25 * (1 + xi) * (1 + eta),
          .25 * (1 - xi) * (1 + eta)};
}

Point blend(const std::array<double, 4>& w, const std::array<Point, 4>& x) {
  return w[0] * x[0] + w[1] * x[1] + w[2] * x[2] + w[3] * x[3];
}

Point along_xi(const std::array<Point, 4>& x, double eta) {
  return .25 * ((1 - eta) * (x[1] - x[0]) + (1 + eta) * (x[2] - x[3]));
}
Point along_eta(const std::array<Point, 4>& x, double xi) {
  return .25 * ((1 - xi) * (x[3] - x[0]) + (1 + xi) * (x[2] - x[1]));
}

double jacobian(const std::array<Point, 8>& x, double xi, double eta, double zeta) {
  Point d[3]{};
  for (int a = 0; a < 8; ++a) {
    const double s = signs[a][0], t = signs[a][1], u = signs[a][2];
    d[0] = d[0] + .125 * s * (1 + t * eta) * (1 + u * zeta) * x[a];
    d[1] = d[1] + .125 * t * (1 + s * xi) * (1 + u * zeta) * x[a];
    d[2] = d[2] + .125 * u * (1 + s * xi) * (1 + t * eta) * x[a];
  }
  return dot(d[0], cross(d[1], d[2]));
}

}  // namespace

double diagonal(const Mesh& mesh) {
  if (mesh.points.empty()) return 0;
  Point low = mesh.points.front(), high = low;
  for (const Point& p : mesh.points)
    for (int c = 0; c < 3; ++c) low[c] = std::min(low[c], p[c]), high[c] = std::max(high[c], p[c]);
  return norm(high - low);
}

Point volume_flux(const std::array<Point, 4>& x) {
  Point flux{};
  for (double xi : {-gauss, gauss})
    for (double eta : {-gauss, gauss}) {
      const Point n = cross(along_xi(x, eta), along_eta(x, xi));
      const Point at = blend(bilinear(xi, eta), x);
      for (int i = 0; i < 3; ++i) flux[i] += at[i] * n[i];
    }
  return flux;
}

double hex_volume(const std::array<Point, 8>& x) {
  double volume = 0;
  for (const auto& s : signs) volume += jacobian(x, gauss * s[0], gauss * s[1], gauss * s[2]);
  return volume;
}

double hex_volume(const Mesh& mesh, int hex) { return hex_volume(corners(mesh, hex)); }

std::array<Point, 8> corners(const Mesh& mesh, int hex) {
  std::array<Point, 8> x;
  for (int a = 0; a < 8; ++a) x[a] = mesh.points[mesh.hexes[hex][a]];
  return x;
}

std::array<Point, 4> corners(const Mesh& mesh, const Quad& q) {
  return {mesh.points[q[0]], mesh.points[q[1]], mesh.points[q[2]], mesh.points[q[3]]};
}

Point center(const Mesh& mesh, int hex) {
  Point sum{};
  for (const Point& p : corners(mesh, hex)) sum = sum + p;
  return .125 * sum;
}

Projection project(const Point& target, const std::array<Point, 4>& x) {
  double xi = 0, eta = 0;
  // Gauss-Newton per direction within the square; a quad of a mesh is nearly a parallelogram, so this settles
  // quickly.
  for (int i = 0; i < 50; ++i) {
    const double before[2] = {xi, eta};
    const Point a = along_xi(x, eta);
    xi = std::clamp(xi + dot(target - blend(bilinear(xi, eta), x), a) / dot(a, a), -1.0, 1.0);
    const Point b = along_eta(x, xi);
    eta = std::clamp(eta + dot(target - blend(bilinear(xi, eta), x), b) / dot(b, b), -1.0, 1.0);
    if (std::abs(xi - before[0]) + std::abs(eta - before[1]) < 1e-13) break;
  }
  Projection p;
  p.weights = bilinear(xi, eta);
  p.point = blend(p.weights, x);
  p.distance = norm(target - p.point);
  return p;
}

}  // namespace bulbus::inline mesh
