#pragma once
#include <vector>

#include "contact/search/local_search.hpp"

namespace bulbus::inline contact {

/// Distance of every point (3 numbers each) to the nearest place of the surface, mm; `farthest` where that is
/// farther.
std::vector<double> distances(std::span<const double> points, const MasterSurface& surface, double farthest);

}  // namespace bulbus::inline contact
