#pragma once
#include <string>
#include <vector>

namespace bulbus::inline app {

/// An option of a command, or what it is given without one.
struct ArgumentOutline {
  std::vector<std::string> names;  ///< "-q", "--quiet"; none of what is given without an option
  std::string value;               ///< stands for its value: "DIR"; empty where an option has none
  std::string about;               ///< what it does, with its default
  std::vector<std::string> words;  ///< the values it may have; empty: any
  bool required = false, repeated = false;
};

/// A command as its help shows it: the common source of help, completion and man page.
struct CommandOutline {
  std::string name, about;
  std::vector<ArgumentOutline> arguments;
};

}  // namespace bulbus::inline app
