#pragma once
#include <array>
#include <span>
#include <vector>

#include "contact/rigid/profile.hpp"
#include "core/base/tensor.hpp"

namespace bulbus::inline contact {

/// A plane with a frame in it: (u, v) = ((x − origin)·along, (x − origin)·away).
struct CuttingPlane {
  Vec3<double> origin, normal, along, away;
  Point2 flat(const Vec3<double>& x) const {
    return {dot(minus(x, origin), along), dot(minus(x, origin), away)};
  }
  Vec3<double> lift(const Point2& p) const {
    Vec3<double> x;
    for (int c = 0; c < 3; ++c) x[c] = origin[c] + p[0] * along[c] + p[1] * away[c];
    return x;
  }
};

/// Where the plane crosses a triangle. Neighbouring segments share an edge of the surface, named by its two
/// corners in order.
struct CutSegment {
  std::array<std::array<int, 2>, 2> edges;
  std::array<Point2, 2> ends;
};

/// The section of a triangulated surface. Corners in the plane count as behind it, so that the section of a
/// closed surface is closed; where this leaves nothing (the surface ends in the plane, in front of it), as in
/// front. May hold segments without length.
std::vector<CutSegment> cut(std::span<const double> points, std::span<const std::array<int, 3>> triangles,
                            const CuttingPlane& plane);

}  // namespace bulbus::inline contact
