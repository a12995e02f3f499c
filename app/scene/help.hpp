#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bulbus {

/// Every key of a scene with its type, unit, default, bounds and one line of help, indented as in the file.
std::string scene_help();

/// The same of a study.
std::string study_help();

/// The JSON schema (draft 2020-12) of a scene, for editors that complete and check YAML.
nlohmann::json scene_schema();

}  // namespace bulbus
