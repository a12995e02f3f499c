#include <fmt/format.h>

#include <algorithm>

#include "app/report/html.hpp"
#include "app/report/sections.hpp"

namespace bulbus::inline app {
namespace {

using nlohmann::json;

std::string whole(const json& of, const char* key) { return std::to_string(of.value(key, 0LL)); }

std::string steps_table(const json& summary) {
  html::Table table{
      {"step", "increments", "Newton iterations", "Krylov iterations", "cuts", "seconds"}, {}, 1};
  double seconds = 0;
  for (const json& s : summary.value("steps", json::array())) {
    table.rows.push_back({html::escaped(s.value("name", "")), whole(s, "increments"),
                          whole(s, "newton_iterations"), whole(s, "krylov_iterations"), whole(s, "cuts"),
                          fmt::format("{:.1f}", s.value("seconds", 0.))});
    seconds += s.value("seconds", 0.);
  }
  const json totals = summary.value("totals", json::object());
  table.rows.push_back({"all", whole(totals, "increments"), whole(totals, "newton_iterations"),
                        whole(totals, "krylov_iterations"), whole(totals, "cuts"),
                        fmt::format("{:.1f}", seconds)});
  return html::table(table, "steps");
}

// Parts by falling size, each with a bar.
std::string bars_of(std::vector<std::pair<std::string, double>> parts, const std::string& unit) {
  std::ranges::sort(parts, std::greater{}, &std::pair<std::string, double>::second);
  html::Table table{{"part", "", unit}, {}, 2};
  const double largest = parts.empty() ? 1 : std::max(parts[0].second, 1e-300);
  for (const auto& [name, value] : parts)
    table.rows.push_back(
        {html::escaped(name),
         fmt::format("<span class=\"bar\" style=\"width:{:.1f}em\"></span>", 12 * value / largest),
         fmt::format("{:.3g}", value)});
  return html::table(table);
}

std::string seconds_table(const json& summary) {
  std::vector<std::pair<std::string, double>> parts;
  const json seconds = summary.value("seconds", json::object());
  for (const auto& [name, value] : seconds.items())
    if (name != "total" && value.is_number()) parts.emplace_back(name, value.get<double>());
  return bars_of(parts, "seconds");
}

std::string memory_table(const json& summary) {
  std::vector<std::pair<std::string, double>> parts;
  const json memory = summary.value("/memory_mb/parts"_json_pointer, json::object());
  for (const auto& [name, value] : memory.items()) parts.emplace_back(name, value.value("all_ranks", 0.));
  return bars_of(parts, "MB");
}

std::string sizes_of(const json& summary) {
  const json peak = summary.value("/memory_mb/process_peak"_json_pointer, json::object());
  const int ranks = summary.value("ranks", 1);
  return fmt::format(
      "{} hexahedra, {} nodes, {} unknowns on {} rank{}: {:.3g} s in all, {:.4g} MB at the peak.",
      whole(summary, "hexahedra"), whole(summary, "nodes"),
      summary.value("/unknowns/total"_json_pointer, 0LL), ranks, ranks == 1 ? "" : "s",
      summary.value("/seconds/total"_json_pointer, 0.), peak.value("all_ranks", 0.));
}

}  // namespace

std::string cost_of(const RunRecord& run) {
  if (run.summary.empty()) return html::text("p", "There is no summary.json yet.");
  const std::string tables =
      html::element("div", html::text("h3", "Seconds by part") + seconds_table(run.summary)) +
      html::element("div", html::text("h3", "Memory by part") + memory_table(run.summary));
  return html::text("p", sizes_of(run.summary)) + steps_table(run.summary) +
         html::element("div", tables, "beside");
}

std::string records_of(const RunRecord& run) {
  constexpr std::size_t most = 500000;  // of a log's characters
  std::string log = run.log_text;
  if (log.size() > most) log = "(the end of the log)\n" + log.substr(log.size() - most);
  std::string records;
  if (!run.scene_text.empty())
    records +=
        html::details("The scene with every default (resolved.yaml)", html::text("pre", run.scene_text));
  if (!log.empty()) records += html::details("The log (run.log)", html::text("pre", log));
  return records;
}

std::string origin_of(const RunRecord& run) {
  std::string words;
  const json versions = run.summary.value("versions", json::object());
  for (const auto& [name, v] : versions.items())
    words += (words.empty() ? "" : ", ") + name + " " + (v.is_string() ? v.get<std::string>() : "");
  return html::text("p", run.folder + (words.empty() ? "" : ": " + words), "note");
}

}  // namespace bulbus::inline app
