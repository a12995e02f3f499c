#pragma once
#include <string>
#include <vector>

#include "contact/interactions.hpp"

namespace bulbus::inline contact {

/// What no point of a slave can feel: corners of the master that have come in between the points. A sentence
/// for every contact whose master has a vertex inside the slave deeper than its points are by a quarter of
/// the width of the slave's face there, or by a tenth where nothing touches. Collective.
std::vector<std::string> entered_vertices(const Problem& problem, const Interactions& interactions,
                                          const State& state);

}  // namespace bulbus::inline contact
