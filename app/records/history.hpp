#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bulbus::inline app {

/// What history.csv of a run's folder says of its probes and of its other columns.
struct History {
  using Column =
      std::vector<std::optional<double>>;  ///< a figure per increment; none: not known in that step
  struct Row {
    std::string step;
    double time = 0;
    Column values;  ///< of the probes
  };
  std::vector<std::string> probes;
  std::vector<std::string> columns;  ///< of numbers: the probes, and what else there is of every increment
  std::map<std::string, Column> others;  ///< those that are no probes
  std::vector<Row> increments;
  std::vector<Row> ends;                     ///< the last increment of every step
  std::vector<double> largest;               ///< magnitude of every probe over all increments
  std::map<std::string, std::string> units;  ///< of columns, where they have one and it is known

  /// Throws InputError if there is no such column.
  Column column(const std::string& name) const;
  /// Empty where there is none.
  std::string unit(const std::string& name) const;
};

/// Throws InputError with file and line if the folder has no history.csv, or it is none of a run.
History read_history(const std::string& folder);

}  // namespace bulbus::inline app
