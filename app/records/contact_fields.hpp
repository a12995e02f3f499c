#pragma once
#include "contact/interactions.hpp"
#include "core/io/vtkhdf.hpp"
#include "core/problem/probes/probe_snapshot.hpp"

namespace bulbus {

/// The fields `gap` (mm), `contact_pressure` (MPa) and `contact_status` (0 open, 1 closed) at the local
/// nodes. A slave of several contacts has its smallest gap, and its pressures summed. Nodes that are no
/// slaves are open, with the largest gap reported (Contact::farthest). None without contacts. Collective.
std::vector<Field> contact_fields(const Interactions& interactions, Snapshot& snapshot);

}  // namespace bulbus
