#include "app/trade/trade_records.hpp"
#include "core/io/table.hpp"

namespace bulbus::inline app {
namespace {

using Cell = CsvTable::Cell;

Cell cell_of(const std::optional<double>& value) { return value ? Cell(*value) : Cell(std::string()); }

std::string front_of(int run, const std::vector<ParetoCandidate>& all) {
  for (const ParetoCandidate& b : all)
    if (b.run == run) return better_than(b, all) ? "dominated" : "front";
  return "";
}

std::vector<std::string> columns_of(const TradeResults& results) {
  std::vector<std::string> columns{"run",
                                   "parameter",
                                   "value",
                                   "mesh",
                                   "converged",
                                   "reason",
                                   "seconds [s]",
                                   "newton_iterations",
                                   "krylov_iterations",
                                   "memory [MB]",
                                   "error",
                                   "error_in",
                                   "front",
                                   "extrapolated_error",
                                   "extrapolated_error_in",
                                   "extrapolated_front"};
  for (const auto& [name, unit] : results.figures)
    columns.insert(columns.end(), {heading(name, unit), name + " error", name + " extrapolated error"});
  return columns;
}

}  // namespace

void write_trade_csv(const std::string& path, const Trade& trade, const TradeResults& results) {
  CsvTable table(path, columns_of(results));
  const auto on_mesh = candidates_on_mesh(trade, results), on_all = candidates_on_all(results);
  for (int run = 0; run < static_cast<int>(results.runs.size()); ++run) {
    if (!results.rows[run]) continue;
    const StudyRow& r = *results.rows[run];
    const TradeRun& of = trade.runs[run];
    std::vector<Cell> row{of.name,
                          of.parameter,
                          of.value,
                          trade.meshes[of.mesh].words,
                          std::string(r.converged ? "true" : "false"),
                          r.reason};
    row.insert(row.end(), {r.seconds, r.newton_iterations, r.krylov_iterations, results.megabytes[run]});
    const auto add_error = [&](const std::optional<TradeError>& e, const std::vector<ParetoCandidate>& all) {
      row.push_back(e ? Cell(e->value) : Cell(std::string()));
      row.emplace_back(e && e->value > 0 ? results.figures[e->figure].name : std::string());
      row.emplace_back(front_of(run, all));
    };
    add_error(mesh_error(trade, results, run), on_mesh);
    add_error(whole_error(results, run), on_all);
    for (int f = 0; f < static_cast<int>(results.figures.size()); ++f)
      for (const auto& v :
           {results.value(run, f), mesh_error(trade, results, run, f), whole_error(results, run, f)})
        row.push_back(cell_of(v));
    table.append(row);
  }
}

}  // namespace bulbus::inline app
