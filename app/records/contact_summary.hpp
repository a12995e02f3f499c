#pragma once
#include <nlohmann/json_fwd.hpp>

#include "contact/interaction_figures.hpp"

namespace bulbus::inline app {

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

/// A sentence for every contact whose multipliers have not come to its tolerance.
std::vector<std::string> missed_tolerances(const Interactions& interactions,
                                           const std::vector<ContactStanding>& standings);

/// A sentence for every point of a suture that pulls without a tangent to the outline of its body, in an
/// older direction.
std::vector<std::string> lost_tangents(const Interactions& interactions, const Model& model);

/// A sentence for every contact without multipliers whose penetration holds more than a twentieth of the
/// energy, its own and that of the tissue: of bodies in series its force is too small by that part. Contacts
/// that just touch are left out. Collective.
std::vector<std::string> soft_contacts(const Problem& problem, const Interactions& interactions,
                                       const std::vector<ContactStanding>& standings, const State& state);

}  // namespace bulbus::inline app
