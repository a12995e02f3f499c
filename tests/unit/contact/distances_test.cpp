#include "contact/search/distances.hpp"

#include <gtest/gtest.h>

#include "contact/search/nearest_point.hpp"
#include "tests/support/sheets.hpp"

namespace bulbus {
namespace {

TEST(Distances, AreThoseOfTheNearestTriangleHoweverFar) {
  const auto body = cylinder(24, 1, 3);
  const MasterSurface surface{body->facets, body->places};
  auto points = noise_vector(3 * 200, 8);
  for (double& p : points) p *= 6;
  const auto found = distances(points, surface, 5);
  int far = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    double nearest = INFINITY;
    for (int t = 0; t < static_cast<int>(body->facets.triangles.size()); ++t)
      nearest =
          std::min(nearest, nearest_point(at(points, static_cast<int>(i)), surface.corners(t)).distance);
    EXPECT_EQ(found[i], nearest <= 5 ? nearest : INFINITY) << i;
    EXPECT_EQ(distance(at(points, static_cast<int>(i)), surface), nearest) << i;
    far += nearest > 5;
  }
  EXPECT_GT(far, 5);
  EXPECT_LT(far, 150);
}

}  // namespace
}  // namespace bulbus
