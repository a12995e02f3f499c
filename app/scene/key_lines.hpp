#pragma once
#include <string>
#include <vector>

#include "core/base/parameters.hpp"

namespace bulbus::inline app {

/// A key of a scene or a study, as help, man page and completion show it.
struct KeyLine {
  std::string key;
  /// From the root: steps.0.increments, regions.NAME.c10; 0 stands for a place in a list, NAME for a name.
  std::string path;
  int depth = 0;                   ///< keys around it
  std::string facts;               ///< "number in MPa, default 1, above 0"
  std::string about;               ///< what it is
  std::string help;                ///< the same with words and conditions
  std::vector<std::string> words;  ///< the values it may have; empty: any of its type
  Level level = Level::everyday;
  bool group = false;     ///< a map of keys that are known, which has no value of its own
  bool has_keys = false;  ///< are there keys below it?
};

/// All keys, each followed by those below it.
std::vector<KeyLine> scene_keys();
std::vector<KeyLine> study_keys();

/// A path without places in lists and NAME: steps.increments, of steps.0.increments.
std::string plain_path(const std::string& path);

}  // namespace bulbus::inline app
