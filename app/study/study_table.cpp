#include <fmt/format.h>

#include <algorithm>

#include "app/study/study_results.hpp"
#include "core/io/terminal.hpp"

namespace bulbus::inline app {
namespace {

using Column = std::vector<std::string>;

constexpr int screen_width = 120;

// The figures of a run that did not converge are marked.
std::string shown(const StudyResults& results, int run, int figure) {
  const auto value = results.value(run, figure);
  return value ? fmt::format("{:.6g}{}", *value, results.converged(run) ? "" : "*") : "-";
}

int width_of(const Column& column) {
  int width = 0;
  for (const std::string& cell : column) width = std::max(width, columns_of(cell));
  return width;
}

std::vector<std::string> block(const std::vector<const Column*>& columns) {
  std::vector<std::string> lines(columns[0]->size());
  for (const Column* column : columns)
    for (std::size_t i = 0; i < lines.size(); ++i)
      lines[i] += std::string(2 + width_of(*column) - columns_of((*column)[i]), ' ') + (*column)[i];
  return lines;
}

}  // namespace

std::vector<std::string> lines_of(const Study& study, const StudyResults& results) {
  std::vector<Column> columns{column_of(results, "run", "", [&](int run) { return results.runs[run]; })};
  for (std::size_t f = 0; f < study.vary.size(); ++f)
    columns.push_back(column_of(results, study.vary[f].name, study.vary[f].unit_text(),
                                [&](int run) { return study.vary[f].text(results.levels[run][f]); }));
  columns.push_back(
      column_of(results, "converged", "", [&](int run) { return results.converged(run) ? "yes" : "no"; }));
  const int fixed = static_cast<int>(columns.size());
  for (int i = 0; i < static_cast<int>(results.figures.size()); ++i)
    columns.push_back(column_of(results, results.figures[i].name, results.figures[i].unit,
                                [&, i](int run) { return shown(results, run, i); }));
  columns.push_back(column_of(results, "Newton", "",
                              [&](int run) { return std::to_string(results.rows[run]->newton_iterations); }));
  columns.push_back(column_of(results, "Krylov", "",
                              [&](int run) { return std::to_string(results.rows[run]->krylov_iterations); }));
  std::vector<std::string> lines = aligned(columns, fixed);
  for (std::size_t run = 0; run < results.runs.size(); ++run)
    if (results.rows[run] && !results.converged(static_cast<int>(run)))
      lines.push_back(fmt::format("* {} did not converge, last good figures: {}", results.runs[run],
                                  results.rows[run]->reason));
  return lines;
}

std::vector<std::string> aligned(const std::vector<Column>& columns, int fixed) {
  std::vector<std::string> lines;
  for (std::size_t next = fixed; next < columns.size();) {
    std::vector<const Column*> fitting;
    int used = 0;
    const auto add = [&](const Column& column) {
      fitting.push_back(&column);
      used += 2 + width_of(column);
    };
    for (int i = 0; i < fixed; ++i) add(columns[i]);
    do add(columns[next++]);
    while (next < columns.size() && used + 2 + width_of(columns[next]) <= screen_width);
    if (!lines.empty()) lines.emplace_back();
    for (std::string& line : block(fitting)) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace bulbus::inline app
