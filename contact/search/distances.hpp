#pragma once
#include <vector>

#include "contact/search/local_search.hpp"

namespace bulbus::inline contact {

/// Distance of every point (3 numbers each) to the nearest place of the surface, mm; infinite where that is
/// farther than `farthest`.
std::vector<double> distances(std::span<const double> points, const MasterSurface& surface, double farthest);

/// The same of one point, however far; every triangle is looked at. Infinite if there is none.
double distance(const Vec3<double>& point, const MasterSurface& surface);

}  // namespace bulbus::inline contact
