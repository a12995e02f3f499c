#pragma once
#include <string>
#include <vector>

namespace bulbus::inline app {

/// A column of a table in the log of a run.
struct LogColumn {
  const char* name;
  int width;  ///< letters of its figures
  const char* meaning;
};

struct LogTable {
  const char* of;  ///< what a line of it is, as a sentence
  std::vector<LogColumn> columns;
};

/// Of Newton's iterations within an increment.
const LogTable& newton_table();
/// Of the search for the unloaded reference.
const LogTable& reference_table();
/// Both.
std::vector<LogTable> log_tables();

/// The names above the figures.
std::string header_of(const LogTable& table);

/// Names and meanings, a line each, for the beginning of a log.
std::vector<std::string> legend_of(const LogTable& table);

}  // namespace bulbus::inline app
