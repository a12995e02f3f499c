#include "app/trade/trade_figure.hpp"

#include <algorithm>
#include <cmath>

namespace bulbus::inline app {
namespace {

constexpr double smallest = 1e-12, shortest = 1e-3;  // errors and seconds below it are drawn there
constexpr std::size_t most_named = 4;                // more curves cannot be told apart

// Hollow of other meshes, which are no sequence that a curve could join.
Chart::Mark mark_of(const TradePoint& p) {
  return {std::log10(std::max(p.seconds, shortest)), std::log10(std::max(p.error, smallest)),
          p.parameter != "mesh"};
}

bool is_scene(const TradePoint& p) { return p.parameter == "scene"; }

// Those with most runs on a front first; of equal ones those that the trade tries first.
std::vector<std::string> named_of(const TradePoints& points) {
  std::vector<std::pair<int, std::string>> all;
  for (const auto* list : {&points.on_all, &points.on_mesh})
    for (const TradePoint& p : *list) {
      if (is_scene(p) || p.parameter == "reference" || !p.front) continue;
      const auto known = std::ranges::find(all, p.parameter, &std::pair<int, std::string>::second);
      if (known == all.end())
        all.emplace_back(1, p.parameter);
      else
        ++known->first;
    }
  std::ranges::stable_sort(all, std::greater{}, &std::pair<int, std::string>::first);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(all.size(), most_named); ++i) names.push_back(all[i].second);
  return names;
}

// The scene as it is belongs to every parameter's curve, but not to that of the meshes.
Chart::Panel panel_of(const std::string& title, const std::vector<TradePoint>& all,
                      const std::vector<std::string>& named) {
  Chart::Panel panel{title, "processor time [s]", {}, {}, true};
  Chart::Series front{"Pareto front", {}}, others{"other settings", {}, true};
  for (const TradePoint& p : all) {
    if (p.front) front.marks.push_back({mark_of(p).x, mark_of(p).y});
    if (std::ranges::find(named, p.parameter) == named.end()) others.marks.push_back(mark_of(p));
  }
  panel.x_ticks = all.empty() ? std::vector<Chart::Tick>{{0, "1"}}
                              : log_ticks(std::max(all.front().seconds, shortest),
                                          std::max(all.back().seconds, shortest));
  panel.series.push_back(std::move(front));
  for (const std::string& name : named) {
    Chart::Series series{name, {}};
    for (const TradePoint& p : all)
      if (p.parameter == name || (is_scene(p) && name != "mesh")) series.marks.push_back(mark_of(p));
    panel.series.push_back(std::move(series));
  }
  panel.series.push_back(std::move(others));
  return panel;
}

}  // namespace

Chart chart_of(const TradePoints& points) {
  Chart chart{.title = "speed and accuracy", .note = "largest relative error of any figure"};
  chart.columns = 2;
  const std::vector<std::string> named = named_of(points);
  chart.panels.push_back(panel_of("against the same mesh", points.on_mesh, named));
  if (!points.on_all.empty())
    chart.panels.push_back(panel_of("against the extrapolated solution", points.on_all, named));
  return chart;
}

}  // namespace bulbus::inline app
