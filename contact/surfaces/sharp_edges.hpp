#pragma once
#include <span>
#include <string>
#include <vector>

#include "contact/surfaces/facets.hpp"

namespace bulbus::inline contact {

/// For every triangle of a surface those that it meets in a corner where the surface is sharp (normals that
/// differ by more than 30 degrees), and convex or concave. Triangles in a plane of symmetry ("x", ...) meet
/// none: the body goes on there as its image.
class SharpEdges {
 public:
  enum class Kind { convex, concave };
  SharpEdges() = default;
  SharpEdges(const Facets& facets, std::span<const double> places, Kind kind,
             std::span<const std::string> symmetry = {});
  bool empty() const { return others_.empty(); }
  /// Ascending.
  std::span<const int> of(int triangle) const {
    return start_.empty()
               ? std::span<const int>{}
               : std::span(others_).subspan(start_[triangle], start_[triangle + 1] - start_[triangle]);
  }

 private:
  std::vector<int> start_, others_;
};

}  // namespace bulbus::inline contact
