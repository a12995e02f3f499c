#include "app/report/history_chart.hpp"

#include <algorithm>

#include "app/study/study_results.hpp"
#include "core/base/did_you_mean.hpp"

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

Chart chart_of(const History& history, const std::vector<std::string>& probes, const std::string& title) {
  const auto ticks = round_ticks(0, history.increments.back().time);
  Chart chart{.title = title};
  for (const std::string& probe : probes) chart.panels.push_back(panel_of(history, probe, ticks));
  return chart;
}

}  // namespace bulbus::inline app
