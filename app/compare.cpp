#include <fmt/format.h>

#include <algorithm>

#include "app/commands.hpp"
#include "app/study/study_results.hpp"

namespace bulbus::inline app {
namespace {

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{:.7g}", *value) : "-";
}

std::vector<std::string> table_of(const std::vector<ComparedFigure>& figures, const CompareOptions& options) {
  std::vector<std::vector<std::string>> columns{{"step", ""},     {"probe", ""},  {"unit", ""},
                                                {"first", ""},    {"second", ""}, {"difference", ""},
                                                {"relative", ""}, {"", ""}};
  for (const ComparedFigure& f : figures) {
    const bool both = f.first && f.second;
    const std::vector<std::string> row{f.step,
                                       f.probe,
                                       f.unit,
                                       text_of(f.first),
                                       text_of(f.second),
                                       both ? fmt::format("{:.2e}", f.difference()) : "-",
                                       both ? fmt::format("{:.2e}", f.relative()) : "-",
                                       f.verdict(options)};
    for (std::size_t c = 0; c < row.size(); ++c) columns[c].push_back(row[c]);
  }
  return aligned(columns, static_cast<int>(columns.size()) - 1);
}

}  // namespace

int compare(const std::string& first, const std::string& second, const CompareOptions& options,
            std::ostream& out) {
  const History a = read_history(first), b = read_history(second);
  const std::vector<ComparedFigure> figures = compared_figures(a, b);
  const auto different =
      std::ranges::count_if(figures, [&](const ComparedFigure& f) { return f.differs(options); });
  out << "first: " << first << "\nsecond: " << second << "\n";
  for (const std::string& line : table_of(figures, options)) out << line << "\n";
  out << fmt::format("{} of {} figures differ by more than {:g} of the probe's largest value{}\n", different,
                     figures.size(), options.relative,
                     options.absolute > 0 ? fmt::format(" and {:g}", options.absolute) : "");
  return different > 0 ? 1 : 0;
}

}  // namespace bulbus::inline app
