#pragma once
#include "contact/interactions.hpp"
#include "core/problem/probes/probes.hpp"

namespace bulbus::inline contact {

/// The kinds of probes of contacts, rigid bodies and sutures, for a ProbeSet:
///
///     contact_area, contact_force, contact_pressure, mean_contact_pressure, penetration, contact_fraction
///                               of a contact; the force is that on its master
///     gap, closed_fraction      of its slave nodes, or of those in the probe's set
///     sealed_fraction           of an edge of its slave
///     body_force, body_moment   of all contacts on a rigid body, about the origin
///     band_tension              of a band
///     suture_force              of one string
///     suture_mises              around the points of a suture
ProbeSet::Kinds interaction_probes(std::shared_ptr<const Interactions> interactions);

}  // namespace bulbus::inline contact
