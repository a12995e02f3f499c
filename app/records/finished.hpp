#pragma once
#include <nlohmann/json_fwd.hpp>

#include "app/scene/scene.hpp"

namespace bulbus::inline app {

/// summary.json of a run's folder; null or discarded if there is none, or nothing but a ruin.
nlohmann::json summary_in(const std::string& folder);

/// Whether the run was ended by a signal, says its summary.
bool was_interrupted(const nlohmann::json& summary);

/// Whether a run in the folder has solved this very scene to its end, converged or not, with this version.
/// One that ran out of memory has not: it may end otherwise on this machine.
bool is_finished(const Scene& scene, const std::string& folder);

}  // namespace bulbus::inline app
