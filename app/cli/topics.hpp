#pragma once
#include <string>
#include <vector>

#include "app/cli/parser.hpp"

namespace bulbus::inline app {

/// What `bulbus help` explains as a whole, beside commands and single keys.
struct Topic {
  std::string name, about;
};
const std::vector<Topic>& topics();

/// The topics, the commands and the keys at the top of a scene, each with a line.
std::string list_of_topics(const Parser& parser, const Terminal& to);

/// Prints what is known of the topic that the parser was given. Returns the exit status. Throws InputError if
/// there is no such topic.
int print_topic(const Parser& parser, const Terminal& to, std::ostream& out, std::ostream& err);

}  // namespace bulbus::inline app
