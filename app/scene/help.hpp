#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "core/base/parameters.hpp"

namespace bulbus::inline app {

/// The keys of a scene up to a level, with type, unit, default, bounds and one line of help, indented as in
/// the file; and how many there are of every level beyond.
std::string scene_help(Level most = Level::everyday);

/// The same of a study.
std::string study_help();

/// The JSON schema (draft 2020-12) of a scene, for editors that complete and check YAML.
nlohmann::json scene_schema();

}  // namespace bulbus::inline app
