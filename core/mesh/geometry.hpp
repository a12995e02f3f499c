#pragma once
#include <array>

#include "core/base/tensor.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

inline Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
/// (1 − t) a + t b
inline Point mix(const Point& a, const Point& b, double t) { return (1 - t) * a + t * b; }

/// ∫ x dA·n over a bilinear quad per component: `{∫ x n_x dA, ∫ y n_y dA, ∫ z n_z dA}` (mm³). Summed over a
/// closed surface with outward normals, each of the three is the volume; the x one needs no lid on the plane
/// x = 0.
Point volume_flux(const std::array<Point, 4>& quad);

/// Exact volume of a trilinear hexahedron, mm³; negative if it is inside out.
double hex_volume(const std::array<Point, 8>& x);
double hex_volume(const Mesh& mesh, int hex);

std::array<Point, 8> corners(const Mesh& mesh, int hex);
std::array<Point, 4> corners(const Mesh& mesh, const Quad& quad);
/// Of the box around all nodes, mm.
double diagonal(const Mesh& mesh);
/// Mean of the corners.
Point center(const Mesh& mesh, int hex);

/// Nearest point of a bilinear quad.
struct Projection {
  std::array<double, 4> weights{};
  Point point{};
  double distance = 0;
};
Projection project(const Point& target, const std::array<Point, 4>& quad);

}  // namespace bulbus::inline mesh
