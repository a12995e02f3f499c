#pragma once
#include <optional>
#include <span>
#include <vector>

#include "contact/rigid/plane_section.hpp"
#include "contact/rigid/rigid_surface.hpp"

namespace bulbus::inline contact {

/// Convex hull, counter-clockwise and without collinear corners, of the body's section with the half of the
/// plane on the side of `away`; empty if the plane misses it. A string that is pulled tight lies on the hull,
/// whatever the hollows of the section.
std::vector<Point2> convex_outline(const RigidSurface& body, const CuttingPlane& plane);

/// The straight part of a string from S to the outline.
struct Tangent {
  Point2 touch, direction;  ///< T and d = (T − S)/|T − S|
  double length = 0;        ///< |T − S|, mm
};

/// Of the two supporting lines of a hull through S the outer one: the hull lies between it and the plane's
/// origin (the middle of the eye). T is the nearest point of contact. Nothing if S is inside the hull or on
/// it, or the hull is empty.
std::optional<Tangent> outer_tangent(std::span<const Point2> hull, const Point2& S);

}  // namespace bulbus::inline contact
