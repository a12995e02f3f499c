#pragma once
#include <span>
#include <vector>

#include "contact/facets.hpp"

namespace bulbus {

/// For every triangle of a surface those that it meets in a corner where the surface is sharp (normals that differ by more than 30 degrees)
/// and convex.
class SharpEdges {
 public:
  SharpEdges() = default;
  SharpEdges(const Facets& facets, std::span<const double> places);
  /// Ascending.
  std::span<const int> of(int triangle) const {
    return start_.empty() ? std::span<const int>{} : std::span(others_).subspan(start_[triangle], start_[triangle + 1] - start_[triangle]);
  }

 private:
  std::vector<int> start_, others_;
};

}  // namespace bulbus
