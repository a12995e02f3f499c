#pragma once
#include <string>

#include "app/cli/outline.hpp"

namespace bulbus::inline app {

/// What a shell offers for the value of an argument.
enum class Offered { nothing, words, settings, topics, scenes, folders, files };
Offered offered_for(const ArgumentOutline& argument);

/// Shell functions that both bash and zsh understand: `_bulbus_keys TYPED` prints the next part of every key
/// of a scene that goes on from there, `_bulbus_words KEY` the values that it may have, `_bulbus_topics
/// TYPED` the topics of help.
std::string shell_functions();

}  // namespace bulbus::inline app
