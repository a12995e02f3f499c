#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/tensor.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

class Problem;
struct State;

/// A radial displacement acts in the direction from its axis that a node has at the start of the step, so
/// that a node that turns about the axis leaves its circle along the tangent.
struct RadialHold {
  DisplaceSpec spec;
  std::vector<std::pair<int, Vec3<double>>> directions;  ///< of local nodes
};

/// A sentence for every set with a radial displacement that is more than a thousandth of its radius away from
/// where the displacement puts it. Collective.
std::vector<std::string> turned_radials(const Problem& problem, const State& state);

}  // namespace bulbus::inline problem
