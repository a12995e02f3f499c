#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace bulbus::inline io {

/// Writes JSON whole or not at all (see write_whole). Numbers that are not finite become null, as JSON has
/// none. Throws std::runtime_error. Not collective.
void write_json(const std::string& path, const nlohmann::json& value);

}  // namespace bulbus::inline io
