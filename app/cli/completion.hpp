#pragma once
#include <string>
#include <vector>

#include "app/cli/outline.hpp"

namespace bulbus::inline app {

/// The script that completes commands, options, files, the keys behind --set with their words, and topics of
/// help, for bash or zsh.
std::string bash_completion(const std::vector<CommandOutline>& commands);
std::string zsh_completion(const std::vector<CommandOutline>& commands);

}  // namespace bulbus::inline app
