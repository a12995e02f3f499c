#pragma once
#include <nlohmann/json_fwd.hpp>

#include "contact/interaction_figures.hpp"

namespace bulbus {

/// What summary.json says of every contact. `standings` are in the order of the contacts.
nlohmann::json contacts_summary(const Interactions& interactions,
                                const std::vector<ContactStanding>& standings);

/// What all contacts do to every rigid body: force (N) and moment about the origin (N mm) of the whole model,
/// and of its parts as drawn, without symmetry images.
nlohmann::json bodies_summary(const Problem& problem, const Interactions& interactions,
                              const std::vector<ContactStanding>& standings);

/// A sentence for every contact that lets its slave in by more than a tenth of the thinner layer: what such a
/// contact says depends on the penalty.
std::vector<std::string> deep_contacts(const Interactions& interactions,
                                       const std::vector<ContactStanding>& standings);

}  // namespace bulbus
