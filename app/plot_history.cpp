#include "app/commands.hpp"
#include "app/records/history.hpp"
#include "app/report/history_chart.hpp"
#include "core/base/error.hpp"
#include "core/io/output.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline app {

void plot_history(const std::string& folder, std::vector<std::string> probes, const std::string& file,
                  const Comm& comm) {
  std::string svg;
  comm.together([&] {
    const History history = read_history(folder);
    if (probes.empty()) probes = history.probes;
    if (history.increments.empty() || probes.empty())
      throw input_error(folder, 0, "its history has nothing to draw", "Give the scene probes, and run it.");
    svg = svg_of(chart_of(history, probes, folder));
  });
  write_together(comm, [&] {
    if (comm.rank() == 0) write_whole(file, svg);
  });
}

}  // namespace bulbus::inline app
