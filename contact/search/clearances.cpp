#include "contact/search/clearances.hpp"

#include <algorithm>
#include <cmath>

namespace bulbus::inline contact {

double greatest_motion(std::span<const double> now, std::span<const double> before) {
  double most = 0;
  for (std::size_t i = 0; i < now.size(); i += 3)
    most = std::max(most, std::pow(now[i] - before[i], 2) + std::pow(now[i + 1] - before[i + 1], 2) +
                              std::pow(now[i + 2] - before[i + 2], 2));
  return std::sqrt(most);
}

void Clearances::move(std::span<const double> points, std::span<const double> surface) {
  if (points_.empty())
    until_.assign(points.size() / 3, way_);
  else
    way_ += greatest_motion(points, points_) + greatest_motion(surface, surface_);
  points_.assign(points.begin(), points.end());
  surface_.assign(surface.begin(), surface.end());
}

}  // namespace bulbus::inline contact
