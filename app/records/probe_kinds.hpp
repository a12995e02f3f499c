#pragma once
#include "app/eye/eye_optics.hpp"
#include "contact/interaction_probes.hpp"

namespace bulbus::inline app {

/// Every kind of probe that core/problem does not know itself.
inline ProbeSet::Kinds probe_kinds(std::shared_ptr<const Interactions> interactions) {
  ProbeSet::Kinds kinds = interaction_probes(std::move(interactions));
  kinds.merge(optical_probes());
  return kinds;
}

}  // namespace bulbus::inline app
