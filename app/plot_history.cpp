#include <algorithm>

#include "app/commands.hpp"
#include "app/plot/chart.hpp"
#include "app/records/history.hpp"
#include "app/study/study_results.hpp"
#include "core/base/did_you_mean.hpp"
#include "core/io/output.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline app {
namespace {

std::size_t index_of(const std::string& probe, const History& history) {
  const auto at = std::ranges::find(history.probes, probe);
  if (at != history.probes.end()) return at - history.probes.begin();
  throw input_error("there is no probe '" + probe + "' in the history",
                    did_you_mean(probe, history.probes, "Name columns of history.csv."));
}

Chart::Panel panel_of(const History& history, const std::string& probe,
                      const std::vector<Chart::Tick>& ticks) {
  const std::size_t p = index_of(probe, history);
  const auto unit = history.units.find(probe);
  Chart::Series series{probe, {}};
  for (const History::Row& row : history.increments)
    if (row.values[p]) series.marks.push_back({row.time, *row.values[p]});
  return {heading(probe, unit == history.units.end() ? "" : unit->second), "steps done", ticks, {series}};
}

}  // namespace

void plot_history(const std::string& folder, std::vector<std::string> probes, const std::string& file,
                  const Comm& comm) {
  std::string svg;
  comm.together([&] {
    const History history = read_history(folder);
    if (probes.empty()) probes = history.probes;
    if (history.increments.empty() || probes.empty())
      throw input_error(folder, 0, "its history has nothing to draw", "Give the scene probes, and run it.");
    const auto ticks = round_ticks(0, history.increments.back().time);
    Chart chart{.title = folder};
    for (const std::string& probe : probes) chart.panels.push_back(panel_of(history, probe, ticks));
    svg = svg_of(chart);
  });
  write_together(comm, [&] {
    if (comm.rank() == 0) write_whole(file, svg);
  });
}

}  // namespace bulbus::inline app
