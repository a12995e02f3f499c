#pragma once
#include "contact/interactions.hpp"
#include "core/problem/probes/probe_figures.hpp"

namespace bulbus::inline contact {

/// The slave nodes that this rank owns, gaps up to Contact::farthest, forces of both ways; found once per
/// snapshot. Collective.
const std::vector<ContactNode>& nodes_of(const Interactions::Contact& contact, Snapshot& snapshot);
/// The same of the master's nodes, where the contact goes both ways; else none. Collective.
const std::vector<ContactNode>& master_nodes_of(const Interactions::Contact& contact, Snapshot& snapshot);

/// What the slave nodes of this rank do to the master.
probes::Resultant on_master(const Interactions::Contact& contact, Snapshot& snapshot);

/// How a contact stands, on all ranks.
struct ContactStanding {
  int touching = 0;               ///< active slave nodes of the model
  double area = 0;                ///< mm², symmetry images included
  double penetration = 0;         ///< largest, mm
  double pressure = 0;            ///< largest, MPa
  std::vector<Wrench> on_master;  ///< per part of a rigid body, as drawn: without images
  Augmentation augmentation;      ///< of the last increment
};
/// Collective.
ContactStanding standing(const Interactions::Contact& contact, Snapshot& snapshot);

}  // namespace bulbus::inline contact
