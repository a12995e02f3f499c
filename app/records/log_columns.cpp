#include "app/records/log_columns.hpp"

#include <fmt/format.h>

namespace bulbus::inline app {

const LogTable& newton_table() {
  static const LogTable table{
      "A line per Newton iteration: the equilibrium error before its step, and the linear solve that made "
      "the "
      "step.",
      {{"it", 3, "Newton iteration"},
       {"force", 8,
        "norm of the residual over the reference force norm, of the region in brackets, which is the worst"},
       {"volume", 8, "largest |V_e/V0_e - 1| of a hexahedron"},
       {"liquid", 8, "violation of a liquid's law, over its volume"},
       {"eta", 7, "relative tolerance of the linear solve (forcing term)"},
       {"Krylov", 6, "iterations of GMRES; 0 with the direct solver"},
       {"reduced", 7, "what the linear solve reached, in parts of its right-hand side"},
       {"length", 6,
        "part of the Newton step that was taken: less than 1 where a full one would invert an element"},
       {"elapsed", 0, "wall-clock time since the start of the run"}}};
  return table;
}

const LogTable& reference_table() {
  static const LogTable table{
      "A line per iteration of the search for the unloaded reference.",
      {{"it", 3, "iteration"},
       {"load", 6, "part of the loads that acts"},
       {"distance, mm", 12, "of the farthest node from where it is drawn, once the loads act"},
       {"ratio", 7, "of the distance to the one before"},
       {"eta", 7, "relative tolerance of the linear solve"},
       {"Krylov", 6, "iterations of GMRES in the one linear solve"},
       {"elapsed", 0, "wall-clock time since the search began"}}};
  return table;
}

std::vector<LogTable> log_tables() { return {newton_table(), reference_table()}; }

std::string header_of(const LogTable& table) {
  std::string header = fmt::format("    {:>{}}", table.columns[0].name, table.columns[0].width);
  for (std::size_t i = 1; i < table.columns.size(); ++i)
    header += fmt::format("  {:<{}}", table.columns[i].name, table.columns[i].width);
  return header;
}

std::vector<std::string> legend_of(const LogTable& table) {
  std::vector<std::string> lines{table.of};
  for (const LogColumn& c : table.columns) lines.push_back(fmt::format("  {:<7}  {}", c.name, c.meaning));
  return lines;
}

}  // namespace bulbus::inline app
