#pragma once
#include <string>

#include "app/cli/parser.hpp"

namespace bulbus::inline app {

/// The manual page bulbus(1) as roff: commands with their options, keys of scenes and studies for everyday
/// use, exit statuses, environment, files.
std::string man_page(const Parser& parser);

}  // namespace bulbus::inline app
