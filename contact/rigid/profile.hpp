#pragma once
#include <array>
#include <string>
#include <vector>

#include "core/problem/spec/rigid_spec.hpp"

namespace bulbus::inline contact {

/// [axial, radial] in a meridian plane, mm.
using Point2 = std::array<double, 2>;
/// Corners of a closed polygon, counter-clockwise about its inside.
using Profile = std::vector<Point2>;

/// Twice the area of a-b-c, positive counter-clockwise, mm².
inline double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Positive for a counter-clockwise polygon, mm².
double signed_area(const Profile& profile);

/// Throws InputError that blames `key` unless the polygon is simple, counter-clockwise and off the axis.
void require_profile(const Profile& profile, const std::string& key);

/// Corners along the closed C² cubic spline through `corners`, whose parameter is the length of the chords.
/// About `points` of them, spread by chord length; the given corners are among them.
Profile periodic_spline(const Profile& corners, int points);

/// Ears of a simple counter-clockwise polygon: triangles between its corners.
std::vector<std::array<int, 3>> triangulate(const Profile& profile);

/// Sections of the shapes. Throw InputError that blames `key` if the measures contradict each other.
Profile profile_of(const SweptShape& shape, const std::string& key);
Profile profile_of(const BandShape& shape, const std::string& key);
Profile profile_of(const TireShape& shape, const std::string& key);

/// The shape whose faces all lie deeper by an inset below its edge radius; the centres of its edges stay.
BandShape made_smaller(BandShape shape, double inset);
TireShape made_smaller(TireShape shape, double inset);

}  // namespace bulbus::inline contact
