#include "core/mesh/distributed/bounds.hpp"

#include <algorithm>
#include <array>

namespace bulbus::inline mesh {

Bounds bounds_of(const Comm& comm, std::span<const double> points) {
  std::array<double, 6> ends;  // greatest of x and of −x
  ends.fill(-1e300);
  for (std::size_t i = 0; i < points.size(); ++i) {
    ends[i % 3] = std::max(ends[i % 3], points[i]);
    ends[3 + i % 3] = std::max(ends[3 + i % 3], -points[i]);
  }
  comm.max(ends);
  return {{-ends[3], -ends[4], -ends[5]}, {ends[0], ends[1], ends[2]}};
}

}  // namespace bulbus::inline mesh
