#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bulbus::inline app {

/// What history.csv of a run's folder says of its probes.
struct History {
  struct Row {
    std::string step;
    double time = 0;
    std::vector<std::optional<double>> values;  ///< of the probes; none: not known in that step
  };
  std::vector<std::string> probes;
  std::vector<Row> increments;
  std::vector<Row> ends;                     ///< the last increment of every step
  std::vector<double> largest;               ///< magnitude of every probe over all increments
  std::map<std::string, std::string> units;  ///< of the probes, from summary.json; none without that file
};

/// Throws InputError with file and line if the folder has no history.csv, or it is none of a run.
History read_history(const std::string& folder);

}  // namespace bulbus::inline app
