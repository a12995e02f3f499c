#include "contact/rigid/plane_section.hpp"

#include <algorithm>
#include <cmath>

namespace bulbus::inline contact {
namespace {

std::vector<CutSegment> cut(std::span<const double> points, std::span<const double> height,
                            std::span<const std::array<int, 3>> triangles, const CuttingPlane& plane,
                            bool zero_in_front) {
  const auto front = [&](int p) { return height[p] > 0 || (zero_in_front && height[p] == 0); };
  const auto flat = [&](int p) { return plane.flat(at(points, p)); };
  std::vector<CutSegment> segments;
  for (const auto& t : triangles) {
    CutSegment s;
    int count = 0;
    for (int i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(t[i], t[(i + 1) % 3]);
      if (front(a) == front(b)) continue;
      const double w = height[a] / (height[a] - height[b]);
      const Point2 p = flat(a), q = flat(b);
      s.edges[count] = {a, b};
      s.ends[count++] = {p[0] + w * (q[0] - p[0]), p[1] + w * (q[1] - p[1])};
    }
    if (count == 2) segments.push_back(s);
  }
  return segments;
}

}  // namespace

std::vector<CutSegment> cut(std::span<const double> points, std::span<const std::array<int, 3>> triangles,
                            const CuttingPlane& plane) {
  std::vector<double> height(points.size() / 3);
  double size = 0;
  for (std::size_t p = 0; p < height.size(); ++p) {
    const Vec3<double> r = minus(at(points, static_cast<int>(p)), plane.origin);
    height[p] = dot(r, plane.normal);
    size = std::max(size, norm(r));
  }
  for (double& h : height)
    if (std::abs(h) <= 1e-9 * size) h = 0;
  auto segments = cut(points, height, triangles, plane, false);
  return segments.empty() ? cut(points, height, triangles, plane, true) : segments;
}

}  // namespace bulbus::inline contact
