#include <fmt/format.h>

#include <algorithm>

#include "app/records/comparison.hpp"
#include "app/report/html.hpp"
#include "app/report/sections.hpp"

namespace bulbus::inline app {
namespace {

std::string cell_of(const std::optional<double>& value) { return value ? html::number(*value) : "–"; }

// The probe of one row, or none: the column `time` is no probe.
std::vector<std::string> row_of(const ComparedFigure& f, const CompareOptions& options) {
  const bool both = f.first && f.second;
  return {html::escaped(f.step),
          html::escaped(f.probe),
          html::escaped(html::unit(f.unit)),
          cell_of(f.first),
          cell_of(f.second),
          both ? fmt::format("{:+.3g}", f.difference() + 0.) : "–",
          both ? fmt::format("{:+.2g} %", 100 * f.relative() + 0.) : "–",
          f.verdict(options)};
}

}  // namespace

Differences differences_of(const RunRecord& a, const RunRecord& b) {
  const CompareOptions options;
  const std::vector<ComparedFigure> figures = compared_figures(a.history, b.history);
  html::Table table{
      {"after", "figure", "unit", "first", "second", "difference", "of the largest value", ""}, {}, 3};
  std::size_t different = 0;
  for (const ComparedFigure& f : figures) {
    different += f.differs(options) ? 1 : 0;
    table.rows.push_back(row_of(f, options));
  }
  const std::string verdict =
      fmt::format("{} of {} figures differ by more than {:g} of the probe's largest value.", different,
                  figures.size(), options.relative);
  return {html::text("p", verdict, different ? "verdict bad" : "verdict good"), html::table(table)};
}

}  // namespace bulbus::inline app
