#pragma once
#include <string>
#include <vector>

#include "app/commands.hpp"

namespace bulbus::inline app {

/// What the command line gives.
struct Arguments {
  std::string command;  ///< run, study, ...
  std::string scene, out, restart, topic, first, second, kind = "eye", over;
  std::vector<std::string> set, columns;
  bool text = false, expert = false, all = false, quiet = false, verbose = false;
  bool restarts = false;  ///< is --restart given, with or without a place?
  int repeat = 1;
  CompareOptions tolerances;
  ExportOptions exported;

  Log::Screen screen() const {
    return quiet ? Log::Screen::quiet : verbose ? Log::Screen::verbose : Log::Screen::shown;
  }
};

}  // namespace bulbus::inline app
