#pragma once
#include <numbers>
#include <string>
#include <vector>

#include "contact/surfaces/facets.hpp"
#include "contact/surfaces/smoothed_facets.hpp"
#include "core/problem/state.hpp"

namespace bulbus::inline contact {

/// The surface of a rigid body that the scene moves: band, tire, plane, ... Several parts may move each its
/// own way (the arcs of a band close radially).
struct RigidSurface {
  struct Part {
    int first_point = 0, points = 0;        ///< its run of points
    int first_triangle = 0, triangles = 0;  ///< and of triangles
    Vec3<double> center{0, 0, 0};           ///< moments and rotations count from here (reference position)
    Vec3<double> inwards{0, 0, 0};          ///< unit direction of `close` as drawn; zero: none
    Vec3<double> closes{0, 0, 0};           ///< the same as the motion has turned it
  };

  std::string name;
  Facets facets;
  std::vector<double> reference;  ///< 3 per point, as drawn
  std::vector<double> places;     ///< 3 per point, where the motion has brought them
  long moves = 0;                 ///< how often they have changed: contacts look for it
  /// At the corners of the triangles, as drawn and as moved; empty where every triangle keeps its own normal.
  std::vector<CornerNormals> reference_normals, normals;
  std::vector<Part> parts;
  /// What the length of a whole turn loses per way by which the arcs close radially: 2π sin h / h, since the
  /// ends of a rigid arc of half angle h come together by 2 sin h.
  double shortening = 2 * std::numbers::pi;
  std::vector<std::string> warnings;  ///< sentences about the file that it was read from
};

}  // namespace bulbus::inline contact
