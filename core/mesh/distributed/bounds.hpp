#pragma once
#include <span>

#include "core/base/parallel.hpp"
#include "core/base/tensor.hpp"

namespace bulbus::inline mesh {

/// The box around points of all ranks, its sides along x, y and z.
struct Bounds {
  Vec3<double> low, high;
  /// On which side of 0 most of it lies along an axis: 1 or −1. Of a mesh, where it is drawn.
  int side(int axis) const { return high[axis] > -low[axis] ? 1 : -1; }
  Vec3<double> sides() const { return {high[0] - low[0], high[1] - low[1], high[2] - low[2]}; }
};

/// `points`: 3 numbers each. Collective.
Bounds bounds_of(const Comm& comm, std::span<const double> points);

}  // namespace bulbus::inline mesh
