#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "app/scene/key_lines.hpp"
#include "core/io/terminal.hpp"

namespace bulbus::inline app {

/// The keys of a scene up to a level, with type, unit, default, bounds and one line of help, indented as in
/// the file; and how many there are of every level beyond. Broken to the width of the terminal, if it is one.
std::string scene_help(Level most = Level::everyday, const Terminal& to = {});

/// The same of a study, whose keys are all for everyday use.
std::string study_help(const Terminal& to = {});

/// The same of one key and those below it: `steps.increments`, `steps.0.increments`; or of every key of that
/// name where its path is not given: `increments`. None if there is no such key of a scene or a study.
std::optional<std::string> key_help(const std::string& path, Level most = Level::everyday,
                                    const Terminal& to = {});

/// Which keys may have that word as their value (`gap`: probes.kind), and the keys beside them that speak of
/// it. None if there is no such key.
std::optional<std::string> word_help(const std::string& word, const Terminal& to = {});

/// The JSON schema (draft 2020-12) of a scene or a study, for editors that complete and check YAML.
nlohmann::json scene_schema();
nlohmann::json study_schema();

}  // namespace bulbus::inline app
