#include <algorithm>
#include <cmath>

#include "app/trade/trade_records.hpp"

namespace bulbus::inline app {
namespace {

constexpr double smallest = 1e-12;  // errors below it are drawn there

std::vector<std::string> parameters_of(const Trade& trade) {
  std::vector<std::string> names;
  for (const TradeRun& run : trade.runs)
    if (std::ranges::find(names, run.parameter) == names.end()) names.push_back(run.parameter);
  return names;
}

Chart::Mark mark_of(const ParetoCandidate& b) {
  return {b.seconds, std::log10(std::max(b.error, smallest)), true};
}

// The scene as it is belongs to every parameter's curve. Where a parameter has no run here the series stays
// empty, so that the legend fits.
Chart::Series series_of(const Trade& trade, const std::string& parameter,
                        const std::vector<ParetoCandidate>& all) {
  Chart::Series series{parameter, {}};
  const bool curve = parameter != "reference" && parameter != "scene" && parameter != "mesh";
  for (const ParetoCandidate& b : all)
    if (trade.runs[b.run].parameter == parameter || (curve && trade.runs[b.run].parameter == "scene"))
      series.marks.push_back(mark_of(b));
  return series;
}

Chart::Panel panel_of(const Trade& trade, const std::string& title, const std::vector<ParetoCandidate>& all) {
  Chart::Panel panel{title, "processor time [s]", {}, {}};
  double least = INFINITY, most = 0;
  Chart::Series front{"Pareto front", {}};
  for (const ParetoCandidate& b : all) {
    least = std::min(least, b.seconds), most = std::max(most, b.seconds);
    if (!better_than(b, all)) front.marks.push_back(mark_of(b));
  }
  panel.x_ticks = all.empty() ? std::vector<Chart::Tick>{{0, "0"}} : round_ticks(least, most);
  panel.series.push_back(std::move(front));
  for (const std::string& parameter : parameters_of(trade))
    if (parameter != "reference") panel.series.push_back(series_of(trade, parameter, all));
  return panel;
}

}  // namespace

Chart chart_of(const Trade& trade, const TradeResults& results) {
  Chart chart{.title = "speed and accuracy: " + trade.runs[1].scene.title,
              .note = "log10 of the largest relative error of any figure"};
  chart.columns = 2;
  chart.panels.push_back(panel_of(trade, "against the same mesh", candidates_on_mesh(trade, results)));
  if (trade.meshes.size() > 1)
    chart.panels.push_back(panel_of(trade, "against the extrapolated solution", candidates_on_all(results)));
  return chart;
}

}  // namespace bulbus::inline app
