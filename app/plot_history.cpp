#include "app/commands.hpp"
#include "app/plot/png.hpp"
#include "app/records/history.hpp"
#include "app/report/history_chart.hpp"
#include "core/base/error.hpp"
#include "core/io/output.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline app {

void plot_history(const std::string& folder, const std::vector<std::string>& columns, const std::string& over,
                  const std::string& file, const Comm& comm) {
  const bool png = file.ends_with(".png");
  std::string svg;
  comm.together([&] {
    if (png) require_png();
    const History history = read_history(folder);
    const std::vector<std::string>& drawn = columns.empty() ? history.probes : columns;
    if (history.increments.empty() || drawn.empty())
      throw input_error(folder, 0, "its history has nothing to draw", "Give the scene probes, and run it.");
    svg = svg_of(chart_of(history, drawn, over.empty() ? "time" : over, folder));
  });
  write_together(comm, [&] {
    if (comm.rank() != 0) return;
    if (png)
      write_png(file, svg);
    else
      write_whole(file, svg);
  });
}

}  // namespace bulbus::inline app
