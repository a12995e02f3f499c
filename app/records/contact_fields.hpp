#pragma once
#include "contact/interactions.hpp"
#include "core/io/vtkhdf.hpp"
#include "core/problem/probes/probe_snapshot.hpp"

namespace bulbus::inline app {

/// The fields `gap` (mm, negative inside the master), `contact_pressure` (MPa, positive) and `contact_status`
/// (0 open, 1 closed) at the local nodes: NaN at nodes that no contact keeps out of anything, and for a gap
/// where the master is farther than Contact::farthest. A node of several contacts has its smallest gap, and
/// its pressures summed; of several contacts each has fields of its own besides: `gap_NAME` and so on. None
/// without contacts. Collective.
std::vector<Field> contact_fields(const Interactions& interactions, Snapshot& snapshot);

}  // namespace bulbus::inline app
