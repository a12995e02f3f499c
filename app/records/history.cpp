#include "app/records/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/records/record_names.hpp"
#include "core/base/did_you_mean.hpp"
#include "core/base/error.hpp"
#include "core/base/parse_number.hpp"
#include "core/base/printable.hpp"
#include "core/io/csv_line.hpp"

namespace bulbus::inline app {
namespace {

// Columns before and after the probes.
constexpr std::size_t before = 3, after = 4;

// A line of the table that is being read.
struct Place {
  const std::string& path;
  int line;
};

InputError no_history(const Place& at, const std::string& why) {
  return input_error(at.path, at.line, why, "Name the folder of the results of a run.");
}

double number(const std::string& cell, const Place& at) {
  const auto value = parse_number<double>(cell);
  if (!value || !std::isfinite(*value)) throw no_history(at, "'" + printable(cell) + "' is no finite number");
  return *value;
}

std::optional<double> figure(const std::string& cell, const Place& at) {
  return cell.empty() ? std::nullopt : std::optional(number(cell, at));
}

void take_row(const std::vector<std::string>& header, const std::vector<std::string>& cells, const Place& at,
              History& history) {
  History::Row row{cells[1], number(cells[2], at), {}};
  for (std::size_t p = 0; p < history.probes.size(); ++p) {
    row.values.push_back(figure(cells[before + p], at));
    history.largest[p] = std::max(history.largest[p], std::abs(row.values.back().value_or(0)));
  }
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (history.others.contains(header[c])) history.others[header[c]].push_back(figure(cells[c], at));
  if (!history.ends.empty() && history.ends.back().step == row.step) history.ends.pop_back();
  history.ends.push_back(row);
  history.increments.push_back(std::move(row));
}

void take_units(const nlohmann::json& units, History& history) {
  if (!units.is_object()) return;
  for (const auto& [column, unit] : units.items())
    if (unit.is_string()) history.units[column] = unit;
}

nlohmann::json json_in(const std::string& path) {
  std::ifstream in(path);
  return in ? nlohmann::json::parse(in, nullptr, false) : nlohmann::json();
}

// Runs of earlier versions have them in their summary alone.
void read_units(const std::string& folder, History& history) {
  const nlohmann::json summary = json_in(folder + "/" + summary_file);
  if (summary.is_object() && summary.contains("units")) take_units(summary["units"], history);
  take_units(json_in(folder + "/" + units_file), history);
}

}  // namespace

History::Column History::column(const std::string& name) const {
  if (const auto other = others.find(name); other != others.end()) return other->second;
  const auto probe = std::ranges::find(probes, name);
  if (probe == probes.end())
    throw input_error("there is no column '" + name + "' of numbers in the history",
                      did_you_mean(name, columns, "Name columns of history.csv."));
  Column figures;
  for (const Row& row : increments) figures.push_back(row.values[probe - probes.begin()]);
  return figures;
}

std::string History::unit(const std::string& name) const {
  const auto found = units.find(name);
  return found == units.end() ? "" : found->second;
}

History read_history(const std::string& folder) {
  const std::string path = folder + "/" + history_file;
  std::ifstream in(path);
  std::string line;
  refuse_study_folder(folder);
  if (!in || !std::getline(in, line)) throw no_history({path, 0}, "cannot be read");
  const std::vector<std::string> header = cells_of_line(line);
  if (header.size() < before + after || header[1] != "step" || header[2] != "time")
    throw no_history({path, 1}, "is no history of a run");
  History history;
  history.probes.assign(header.begin() + before, header.end() - after);
  history.largest.resize(history.probes.size());
  history.columns = history.probes;
  for (std::size_t c = 0; c < header.size(); ++c)
    if (const bool probe = c >= before && c < header.size() - after; !probe && header[c] != "step") {
      history.columns.push_back(header[c]);
      history.others[header[c]];
    }
  for (int at = 2; std::getline(in, line); ++at) {
    const std::vector<std::string> row = cells_of_line(line);
    if (row.size() != header.size())
      throw no_history({path, at}, fmt::format("has {} cells, its header has {}", row.size(), header.size()));
    take_row(header, row, {path, at}, history);
  }
  read_units(folder, history);
  return history;
}

}  // namespace bulbus::inline app
