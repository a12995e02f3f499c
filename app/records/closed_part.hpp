#pragma once
#include <optional>

#include "core/problem/model.hpp"

namespace bulbus::inline app {

/// The part of its nodes, 0 to 1, that are closed in the state of which a probe records `value`. None of
/// other kinds, nor where the record is a change (`since`), the largest so far (`peak`) or reversed in sign.
inline std::optional<double> closed_part(const ProbeSpec& p, double value) {
  if (p.kind != "closed_fraction" || !p.since.empty() || p.peak || !(p.scale > 0)) return {};
  return value / p.scale;
}

}  // namespace bulbus::inline app
