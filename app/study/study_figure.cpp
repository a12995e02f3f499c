#include "app/study/study_figure.hpp"

#include <algorithm>

namespace bulbus::inline app {
namespace {

// The first with several numbers, else the first with several values.
int abscissa_factor(const Study& study) {
  const auto& vary = study.vary;
  auto at =
      std::ranges::find_if(vary, [](const Factor& f) { return f.levels() > 1 && !f.numbers().empty(); });
  if (at == vary.end()) at = std::ranges::find_if(vary, [](const Factor& f) { return f.levels() > 1; });
  return at == vary.end() ? 0 : static_cast<int>(at - vary.begin());
}

std::vector<Chart::Tick> ticks_of(const Factor& factor) {
  std::vector<Chart::Tick> ticks;
  for (int level = 0; level < factor.levels(); ++level)
    ticks.push_back({abscissa(factor, level), factor.text(level)});
  std::ranges::sort(ticks, {}, &Chart::Tick::at);
  return ticks;
}

Chart::Series series_of(const Study& study, const StudyResults& results, const Line& line, int figure) {
  Chart::Series series{words_of(study, results.levels[line.runs[0]], line.factor), {}};
  for (int run : line.runs)
    if (const auto value = results.value(run, figure))
      series.marks.push_back({abscissa(study.vary[line.factor], results.levels[run][line.factor]), *value,
                              results.converged(run)});
  return series;
}

Chart::Panel panel_of(const Study& study, const StudyResults& results, int factor, int figure) {
  const Factor& f = study.vary[factor];
  Chart::Panel panel{heading(results.figures[figure].name, results.figures[figure].unit),
                     heading(f.name, f.unit_text()),
                     ticks_of(f),
                     {}};
  for (const Line& line : lines_along(factor, study, results.levels))
    panel.series.push_back(series_of(study, results, line, figure));
  return panel;
}

std::string note_of(const Study& study, const StudyResults& results) {
  std::string note = study.design == "product" ? "" : "baseline: " + words_of(study, results.levels[0]);
  const auto failed = [](const auto& row) { return row && !row->converged; };
  if (std::ranges::any_of(results.rows, failed))
    note += (note.empty() ? "" : "; ") +
            std::string("hollow: not converged, last good figures (arrows: beyond the scale)");
  return note;
}

}  // namespace

Chart chart_of(const Study& study, const StudyResults& results) {
  Chart chart{.title = study.title, .note = note_of(study, results)};
  std::vector<int> factors{abscissa_factor(study)};
  if (study.design != "product") {
    factors.clear();
    for (int f = 0; f < static_cast<int>(study.vary.size()); ++f)
      if (study.vary[f].levels() > 1) factors.push_back(f);
    chart.columns = static_cast<int>(factors.size());
    chart.rows_share_y = true;  // how much each factor matters shows at a glance
  }
  for (int figure = 0; figure < static_cast<int>(results.figures.size()); ++figure)
    for (int factor : factors) chart.panels.push_back(panel_of(study, results, factor, figure));
  return chart;
}

}  // namespace bulbus::inline app
