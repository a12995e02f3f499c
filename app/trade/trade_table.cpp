#include <fmt/format.h>

#include <algorithm>

#include "app/trade/trade_records.hpp"

namespace bulbus::inline app {
namespace {

using Column = std::vector<std::string>;
using Lines = std::vector<std::string>;

std::string percent(double error) { return fmt::format("{:.2g} %", 100 * error); }

std::string shown(const std::optional<TradeError>& e) { return e ? percent(e->value) : "-"; }

std::string name_of(const TradeRun& run) {
  return run.value.empty() ? run.parameter : run.parameter + " " + run.value;
}

Lines runs(const Trade& trade, const TradeResults& results) {
  const auto row = [&](int run) -> const StudyRow& { return *results.rows[run]; };
  const auto column = [&](const char* name, const char* unit, auto text) {
    return column_of(results, name, unit, text);
  };
  return aligned({column("run", "", [&](int r) { return results.runs[r]; }),
                  column("parameter", "", [&](int r) { return trade.runs[r].parameter; }),
                  column("value", "", [&](int r) { return trade.runs[r].value; }),
                  column("time", "s", [&](int r) { return fmt::format("{:.1f}", row(r).seconds); }),
                  column("Newton", "", [&](int r) { return std::to_string(row(r).newton_iterations); }),
                  column("Krylov", "", [&](int r) { return std::to_string(row(r).krylov_iterations); }),
                  column("memory", "MB", [&](int r) { return fmt::format("{:.0f}", results.megabytes[r]); }),
                  column("error", "same mesh",
                         [&](int r) {
                           return row(r).converged ? shown(mesh_error(trade, results, r))
                                                   : row(r).reason.substr(0, 30);
                         }),
                  column("in", "",
                         [&](int r) {
                           const auto e = mesh_error(trade, results, r);
                           return e && e->value > 0 ? results.figures[e->figure].name : std::string();
                         }),
                  column("error", "extrapolated", [&](int r) { return shown(whole_error(results, r)); })},
                 3);
}

// Every figure's errors with each accuracy, on the scene's mesh.
Lines accuracies(const Trade& trade, const TradeResults& results) {
  std::vector<Column> columns{{"figure", ""}, {"tight reference", ""}, {"extrapolated", ""}};
  for (std::size_t f = 0; f < results.figures.size(); ++f) {
    const auto value = results.value(0, static_cast<int>(f));
    columns[0].push_back(heading(results.figures[f].name, results.figures[f].unit));
    columns[1].push_back(value ? fmt::format("{:.6g}", *value) : "-");
    columns[2].push_back(results.extrapolated[f] ? fmt::format("{:.6g}", results.extrapolated[f]->value)
                                                 : "-");
  }
  for (int run = 1; run < static_cast<int>(results.runs.size()); ++run)
    if (trade.runs[run].parameter == "accuracy" || trade.runs[run].parameter == "scene") {
      columns.push_back({trade.runs[run].value, "error"});
      for (std::size_t f = 0; f < results.figures.size(); ++f) {
        const auto e = mesh_error(trade, results, run, static_cast<int>(f));
        columns.back().push_back(e ? percent(*e) : "-");
      }
    }
  return aligned(columns, 1);
}

void add_front(const Trade& trade, const std::vector<ParetoCandidate>& all, const std::string& title,
               Lines& lines) {
  if (all.empty()) return;
  lines.insert(lines.end(), {"", title});
  for (const ParetoCandidate& b : all)
    if (!better_than(b, all))
      lines.push_back(
          fmt::format("  {:>8.1f} s  {:>10}  {}", b.seconds, percent(b.error), name_of(trade.runs[b.run])));
}

void add_dominated(const Trade& trade, const std::vector<ParetoCandidate>& all, Lines& lines) {
  if (all.empty()) return;
  lines.insert(lines.end(), {"", "dominated, on the same mesh:"});
  for (const ParetoCandidate& b : all)
    if (const ParetoCandidate* better = better_than(b, all))
      lines.push_back(fmt::format("  {} ({:.1f} s, {}): {} takes {:.1f} s, {}", name_of(trade.runs[b.run]),
                                  b.seconds, percent(b.error), name_of(trade.runs[better->run]),
                                  better->seconds, percent(better->error)));
}

}  // namespace

std::vector<std::string> lines_of(const Trade& trade, const TradeResults& results) {
  Lines lines = runs(trade, results);
  lines.emplace_back();
  for (std::string& line : accuracies(trade, results)) lines.push_back(std::move(line));
  for (const TradeMesh& mesh : trade.meshes)
    if (!mesh.kept.empty())
      lines.push_back(fmt::format("  not extrapolated from {}: {} did not change", mesh.words, mesh.kept));
  const auto on_mesh = candidates_on_mesh(trade, results);
  add_front(trade, on_mesh, "Pareto front, errors against the tight solution on the same mesh:", lines);
  add_front(trade, candidates_on_all(results),
            "Pareto front, errors against the extrapolated solution:", lines);
  add_dominated(trade, on_mesh, lines);
  return lines;
}

}  // namespace bulbus::inline app
