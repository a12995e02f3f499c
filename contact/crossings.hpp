#pragma once
#include <string>
#include <vector>

#include "contact/interactions.hpp"

namespace bulbus::inline contact {

/// Where surfaces have passed through one another, or through themselves, and no contact keeps them apart: a
/// sentence for every pair of regions, or region and rigid body, with the place of one hexahedron that is
/// passed through. Pairs that a contact names are left to it. Collective.
std::vector<std::string> crossed_surfaces(const Problem& problem, const Interactions& interactions,
                                          const State& state);

}  // namespace bulbus::inline contact
