#pragma once
#include <string>

#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Refuse what a displacement, a load or a probe gives without effect, such as `direction` of a pressure that
/// follows the face: whoever gives it means something by it. Values that are the default are passed over.
/// `key`: the entry's place in the scene. Throw InputError.
void refuse_idle_keys(const DisplaceSpec& spec, const std::string& key);
void refuse_idle_keys(const LoadSpec& spec, const std::string& key);
void refuse_idle_keys(const ProbeSpec& spec, const std::string& key);

/// Whether a probe of this kind has values over a set or region that its `statistic` makes one of.
bool has_statistic(const std::string& kind);

}  // namespace bulbus::inline problem
