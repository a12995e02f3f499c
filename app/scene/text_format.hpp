#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/base/parameters.hpp"
#include "core/base/require_one.hpp"

namespace bulbus::inline app {

/// Shortest text that reads back as the same double, in a form that every YAML reader takes for a number.
std::string number_text(double value);

/// "between 0 and 10", "above 0", "at least 1"; empty without bounds.
std::string bounds_text(const About& about);

/// "; only with method: iterative and displacement: hybrid or exact"; empty without conditions.
std::string conditions_text(std::span<const Condition> conditions);

/// What a number may be: "a number in MPa (or with its unit), above 0".
std::string wanted_number(const About& about);

}  // namespace bulbus::inline app
