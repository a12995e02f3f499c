#include "app/report/history_chart.hpp"

#include <algorithm>

#include "app/study/study_results.hpp"

namespace bulbus::inline app {
namespace {

// Along the abscissa.
struct Abscissa {
  History::Column figures;
  std::string label;
  std::vector<Chart::Tick> ticks;
};

Abscissa abscissa_of(const History& history, const std::string& column) {
  Abscissa along{history.column(column), heading(column, history.unit(column)), {}};
  const bool steps = column == "time";
  double low = steps ? 0 : INFINITY, high = -INFINITY;
  for (const auto& x : along.figures)
    if (x) low = std::min(low, *x), high = std::max(high, *x);
  if (steps) along.label = "steps done";
  along.ticks = low <= high ? round_ticks(low, high) : round_ticks(0, 0);
  return along;
}

Chart::Panel panel_of(const History& history, const std::string& column, const Abscissa& along) {
  const History::Column figures = history.column(column);
  Chart::Series series{column, {}};
  for (std::size_t i = 0; i < figures.size(); ++i)
    if (figures[i] && along.figures[i]) series.marks.push_back({*along.figures[i], *figures[i]});
  return {heading(column, history.unit(column)), along.label, along.ticks, {series}};
}

}  // namespace

Chart chart_of(const History& history, const std::vector<std::string>& columns, const std::string& over,
               const std::string& title) {
  const Abscissa along = abscissa_of(history, over);
  Chart chart{.title = title};
  for (const std::string& column : columns) chart.panels.push_back(panel_of(history, column, along));
  return chart;
}

}  // namespace bulbus::inline app
