#pragma once
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "app/study/study_design.hpp"

namespace bulbus::inline app {

/// What a run came to.
struct StudyRow {
  bool converged = false;
  std::string reason;
  std::vector<std::optional<double>>
      values;  ///< of the figures; of the last good state where it did not converge
  long long newton_iterations = 0, krylov_iterations = 0;
  double seconds = 0;
};

/// What a study has found so far.
struct StudyResults {
  struct Figure {
    std::string name, unit;
  };
  std::vector<Figure> figures;
  std::vector<std::string> runs;              ///< their folders
  std::vector<Levels> levels;                 ///< of every run
  std::vector<std::optional<StudyRow>> rows;  ///< none: not run yet

  /// The value of a figure; none if it is not known.
  std::optional<double> value(int run, int figure) const {
    return rows[run] ? rows[run]->values[figure] : std::nullopt;
  }
  bool converged(int run) const { return rows[run] && rows[run]->converged; }
};

/// "close [mm]"; the name alone without a unit.
std::string heading(const std::string& name, const std::string& unit);

/// Takes the figures of a run, and their units, from its summary.json.
void take(StudyResults& results, int run, const nlohmann::json& summary);

/// Writes study.csv, one row per run done. Throws std::runtime_error. Not collective.
void write_study_csv(const std::string& path, const Study& study, const StudyResults& results);

/// The same as a table for people, in blocks that fit a screen.
std::vector<std::string> lines_of(const Study& study, const StudyResults& results);

/// A column of the runs done: its heading, its unit and the text of every run.
template <class Text>
std::vector<std::string> column_of(const StudyResults& results, const std::string& name,
                                   const std::string& unit, Text text) {
  std::vector<std::string> column{name, unit};
  for (int run = 0; run < static_cast<int>(results.runs.size()); ++run)
    if (results.rows[run]) column.push_back(text(run));
  return column;
}

/// Columns of text, right-aligned; those that do not fit the screen follow in further blocks, behind the
/// first `fixed`.
std::vector<std::string> aligned(const std::vector<std::vector<std::string>>& columns, int fixed);

}  // namespace bulbus::inline app
