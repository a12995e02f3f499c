#include "app/study/study_results.hpp"

#include <nlohmann/json.hpp>

#include "core/io/table.hpp"

namespace bulbus::inline app {
namespace {

CsvTable::Cell cell_of(const Factor& factor, int level) {
  const auto numbers = factor.numbers();
  if (numbers.empty() || !factor.labels.empty()) return factor.text(level);
  return numbers[level];
}

}  // namespace

std::string heading(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : name + " [" + unit + "]";
}

void take(StudyResults& results, int run, const nlohmann::json& summary) {
  StudyRow row;
  row.converged = summary.at("converged");
  row.reason = row.converged ? "" : summary.at("reason").get<std::string>();
  for (StudyResults::Figure& figure : results.figures) {
    figure.unit = summary.at("units").at(figure.name);
    const auto& value = summary.at("probes").at(figure.name);
    row.values.push_back(value.is_number() ? std::optional(value.get<double>()) : std::nullopt);
  }
  row.newton_iterations = summary.at("totals").at("newton_iterations");
  row.krylov_iterations = summary.at("totals").at("krylov_iterations");
  row.seconds = summary.at("seconds").at("total");
  results.rows[run] = std::move(row);
}

void write_study_csv(const std::string& path, const Study& study, const StudyResults& results) {
  std::vector<std::string> columns{"run"};
  for (const Factor& f : study.vary)
    columns.push_back(heading(f.name, f.labels.empty() ? f.unit_text() : ""));
  for (const char* c : {"converged", "reason"}) columns.emplace_back(c);
  for (const auto& figure : results.figures) columns.push_back(heading(figure.name, figure.unit));
  for (const char* c : {"newton_iterations", "krylov_iterations", "seconds"}) columns.emplace_back(c);
  CsvTable table(path, columns);
  for (std::size_t run = 0; run < results.runs.size(); ++run) {
    if (!results.rows[run]) continue;
    const StudyRow& r = *results.rows[run];
    std::vector<CsvTable::Cell> row{results.runs[run]};
    for (std::size_t f = 0; f < study.vary.size(); ++f)
      row.push_back(cell_of(study.vary[f], results.levels[run][f]));
    row.insert(row.end(), {std::string(r.converged ? "true" : "false"), r.reason});
    for (const auto& value : r.values)
      row.push_back(value ? CsvTable::Cell(*value) : CsvTable::Cell(std::string()));
    row.insert(row.end(), {r.newton_iterations, r.krylov_iterations, r.seconds});
    table.append(row);
  }
}

}  // namespace bulbus::inline app
