#pragma once
#include <array>
#include <vector>

#include "core/base/tensor.hpp"
#include "core/io/archive.hpp"

namespace bulbus::inline problem {

/// Placement of a rigid body: x = center + shift + rotation (X − center).
struct Pose {
  Mat3<double> rotation{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};
  Vec3<double> shift{0, 0, 0};
};

/// All that changes during a run, on one rank.
struct State {
  std::vector<double> x;       ///< positions of the local nodes, ghosts included, mm
  std::vector<double> lambda;  ///< Cauchy mean stress of the local hexahedra, MPa
  std::vector<double> P;       ///< pressure of every liquid, the same on every rank, MPa
  std::vector<Pose> bodies;    ///< the same on every rank
  void serialize(Archive& archive);
};

/// Rotation by rows and shift, 12 numbers each.
void serialize(Archive& archive, const std::string& name, std::vector<Pose>& poses);

}  // namespace bulbus::inline problem
