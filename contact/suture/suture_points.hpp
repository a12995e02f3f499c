#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/spec/rigid_spec.hpp"

namespace bulbus::inline contact {

/// Where a string holds the tissue: S = Σ weight · x(node).
struct SuturePoint {
  Point place{};                   ///< of the undeformed tissue, mm
  std::vector<int> nodes;          ///< of the Mesh, sorted
  std::vector<double> weights;     ///< sum to 1
  std::array<bool, 3> on_plane{};  ///< lies on the symmetry plane x, y, z = 0
  double share = 1;                ///< of the force that the model owns: ½ per plane it lies on
};

/// The points of a suture on the undeformed mesh. `symmetry`: the planes that cut the model ("x", ...). `key`
/// is the path of the spec in the scene ("sutures.first"). Throws InputError.
std::vector<SuturePoint> suture_points(const Mesh& mesh, const SutureSpec& spec,
                                       std::span<const std::string> symmetry, const std::string& key);

/// Two points of a surface at half the spacing, measured along its meridian, on either side of the axial
/// place; where the meridian passes that place twice, of the outer branch. The one at the smaller axial
/// position first. Throws InputError.
std::array<Point, 2> points_on_meridian(const Mesh& mesh, const SutureSpec& spec, const std::string& key);

/// Weights ∫ N dA / ∫ dA over the part of the surface within the circle of the given area about its nearest
/// point to `place`; those of that point alone where the circle is too small for the quadrature.
SuturePoint bite(const Mesh& mesh, const std::vector<Quad>& faces, const Point& place, double area);

}  // namespace bulbus::inline contact
