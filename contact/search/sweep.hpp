#pragma once
#include <span>

#include "contact/search/local_search.hpp"

namespace bulbus::inline contact {

/// A way from one position to another, mm.
struct Way {
  Vec3<double> from, to;
};

/// The triangle through which a point's way leads from the front of a moving surface to its back; of several
/// the one that it meets first; −1: none. In the frame of a triangle that goes along with it the gap and the
/// weights of the projection change linearly:
///     t = G0 / (G0 − G1),  L = (1 − t) L0 + t L1
/// exact where the surface moves rigidly. Crossings that miss a triangle by a twentieth of its height count:
/// whether the point is inside is then decided where it is now. `before`: positions of the corners at the
/// start of the way, none of which has moved farther than `motion` (mm); `candidates`: all triangles within
/// the length of the way, relative to the surface, of its end. `on_surface`: gaps that are 0 but for
/// rounding, mm; `rise`: how far before a hollow surface its triangles lie at most, mm, so that a point
/// between the two is in front.
int entered_through(const MasterSurface& now, std::span<const double> before, double motion, const Way& way,
                    std::span<const int> candidates, double on_surface, double rise);

/// A point whose way ends farther from the surface than this has not come through it, mm.
double farthest_crossing(const MasterSurface& now, double motion, const Way& way);

/// Walks from triangle to triangle as long as the nearest point comes no farther from x: the triangle of the
/// nearest point of that part of the surface.
int nearest_from(const MasterSurface& master, const Vec3<double>& x, int start);

}  // namespace bulbus::inline contact
