#include <filesystem>

#include "app/commands.hpp"
#include "app/plot/png.hpp"
#include "app/records/history.hpp"
#include "app/records/record_names.hpp"
#include "app/report/history_chart.hpp"
#include "app/trade/trade_figure.hpp"
#include "core/base/error.hpp"
#include "core/io/output.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline app {
namespace {

Chart history_chart(const std::string& folder, const std::vector<std::string>& columns,
                    const std::string& over) {
  const History history = read_history(folder);
  const std::vector<std::string>& drawn = columns.empty() ? history.probes : columns;
  if (history.increments.empty() || drawn.empty())
    throw input_error(folder, 0, "its history has nothing to draw", "Give the scene probes, and run it.");
  return chart_of(history, drawn, over.empty() ? "time" : over, folder);
}

Chart trade_chart(const std::string& path, const std::vector<std::string>& columns, const std::string& over) {
  if (!columns.empty() || !over.empty())
    throw input_error(path, 0, "has no history whose columns could be drawn",
                      "Leave out columns and --over, or name one of the trade's runs.");
  return chart_of(read_trade_points(path));
}

}  // namespace

std::string plot(const std::string& folder, const std::vector<std::string>& columns, const std::string& over,
                 const std::string& file, const Comm& comm) {
  std::string path = file, svg;
  comm.together([&] {
    const std::string table = folder + "/" + trade_file;
    const bool trade = std::filesystem::exists(table);
    if (path.empty()) path = folder + (trade ? "/trade.svg" : "/history.svg");
    if (path.ends_with(".png")) require_png();
    svg = svg_of(trade ? trade_chart(table, columns, over) : history_chart(folder, columns, over));
  });
  write_together(comm, [&] {
    if (comm.rank() != 0) return;
    if (path.ends_with(".png"))
      write_png(path, svg);
    else
      write_whole(path, svg);
  });
  return path;
}

}  // namespace bulbus::inline app
