#include "app/report/history_chart.hpp"
#include "app/report/html.hpp"
#include "app/report/probe_words.hpp"
#include "app/report/sections.hpp"

namespace bulbus::inline app {

std::string meaning_of(const RunRecord& run, const std::string& probe) {
  const ProbeSpec* spec = run.probe(probe);
  return spec ? meaning_of(*spec) : "";
}

std::string figures_of(const RunRecord& run) {
  const History& history = run.history;
  if (history.probes.empty()) return html::text("p", "The scene has no probes.");
  html::Table table{{"figure", "meaning", "unit"}, {}, 3};
  for (const History::Row& end : history.ends) table.header.push_back("after " + html::escaped(end.step));
  for (std::size_t p = 0; p < history.probes.size(); ++p) {
    const std::string& name = history.probes[p];
    std::vector<std::string> row{html::escaped(name), html::escaped(meaning_of(run, name)),
                                 html::escaped(html::unit(run.unit(name)))};
    for (const History::Row& end : history.ends)
      row.push_back(end.values[p] ? html::number(*end.values[p]) : "–");
    table.rows.push_back(row);
  }
  return html::table(table) +
         html::text("p",
                    "Forces, moments, areas and volumes are of the whole model, mirrored parts included, "
                    "where they are not said to be of the drawn part alone.",
                    "note");
}

std::string histories_of(const RunRecord& run) {
  if (run.history.increments.empty() || run.history.probes.empty())
    return html::text("p", "There is no history.");
  const std::string svg = svg_of(chart_of(run.history, run.history.probes, "time", ""));
  return html::element("div", svg.substr(svg.find("<svg")), "wide");
}

}  // namespace bulbus::inline app
