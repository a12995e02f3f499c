#include "app/study/study_trend.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace bulbus::inline app {
namespace {

using Kind = Course::Kind;

// "rising", or "rising 3, not monotone 1" where lines differ.
std::string counted(const std::map<Kind, int>& lines) {
  if (lines.size() == 1) return name_of(lines.begin()->first);
  std::string text;
  for (const auto& [kind, count] : lines)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name_of(kind), count);
  return text;
}

}  // namespace

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::constant:
      return "constant";
    case Kind::rising:
      return "rising";
    case Kind::falling:
      return "falling";
    case Kind::mixed:
      return "not monotone";
    default:
      return "unknown";
  }
}

Course course_of(std::span<const double> values, double tolerance) {
  if (values.size() < 2) return {};
  double largest = 0;
  for (double v : values) largest = std::max(largest, std::abs(v));
  Course course{Kind::constant, {}};
  int direction = 0;
  std::size_t last = 0;  // the value that changes count from
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double change = values[i] - values[last];
    if (std::abs(change) <= tolerance * largest) continue;
    const int now = change > 0 ? 1 : -1;
    if (direction && now != direction) course.turns.push_back(static_cast<int>(last));
    direction = now;
    last = i;
  }
  if (direction)
    course.kind = !course.turns.empty() ? Kind::mixed : direction > 0 ? Kind::rising : Kind::falling;
  return course;
}

std::vector<Trend> trends_of(const Study& study, const StudyResults& results) {
  std::vector<Trend> trends;
  for (int factor = 0; factor < static_cast<int>(study.vary.size()); ++factor)
    for (const Line& line : lines_along(factor, study, results.levels))
      for (int figure = 0; figure < static_cast<int>(results.figures.size()); ++figure) {
        Trend trend{line, figure, {}, {}};
        std::vector<double> values;
        for (int run : line.runs)
          if (const auto value = results.value(run, figure); value && results.converged(run)) {
            trend.runs.push_back(run);
            values.push_back(*value);
          }
        trend.course = course_of(values, study.tolerance);
        trends.push_back(std::move(trend));
      }
  return trends;
}

std::string words_of(const Study& study, const StudyResults& results, const Trend& trend) {
  std::string words = name_of(trend.course.kind), turns;
  for (int t : trend.course.turns)
    turns += (turns.empty() ? ": turns at " : ", ") +
             study.vary[trend.line.factor].text(results.levels[trend.runs[t]][trend.line.factor]);
  return words + turns;
}

std::vector<std::string> lines_of(const Study& study, const StudyResults& results,
                                  const std::vector<Trend>& trends) {
  std::map<int, std::map<int, std::map<Kind, int>>> counts;  // by factor and figure
  std::vector<std::string> details;
  for (const Trend& trend : trends) {
    const int factor = trend.line.factor;
    ++counts[factor][trend.figure][trend.course.kind];
    if (trend.course.kind != Kind::mixed) continue;
    const std::string at = words_of(study, results.levels[trend.line.runs[0]], factor);
    details.push_back(fmt::format("{} in {}{} is {}", results.figures[trend.figure].name,
                                  study.vary[factor].name, at.empty() ? "" : " (" + at + ")",
                                  words_of(study, results, trend)));
  }
  std::vector<std::vector<std::string>> columns{{""}};
  bool differ = false;
  for (const auto& figure : results.figures) columns[0].push_back(figure.name);
  for (const auto& [factor, figures] : counts) {
    columns.push_back({study.vary[factor].name});
    for (const auto& [figure, lines] : figures) {
      columns.back().push_back(counted(lines));
      differ = differ || lines.size() > 1;
    }
  }
  if (columns.size() == 1) return {};
  std::vector<std::string> lines{"along each factor, the others fixed, of the runs that converged:"};
  if (differ)
    lines.emplace_back(
        "('rising 2, falling 1': the figure rises with 2 of the values that the others take, and falls with "
        "1)");
  for (std::string& line : aligned(columns, 1)) lines.push_back(std::move(line));
  lines.insert(lines.end(), details.begin(), details.end());
  return lines;
}

}  // namespace bulbus::inline app
