#include "app/study/study_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace bulbus::inline app {
namespace {

std::vector<Levels> product(const Study& study) {
  std::vector<Levels> runs{{}};
  for (const Factor& factor : study.vary) {
    std::vector<Levels> longer;
    for (const Levels& run : runs)
      for (int level = 0; level < factor.levels(); ++level) {
        longer.push_back(run);
        longer.back().push_back(level);
      }
    runs = std::move(longer);
  }
  return runs;
}

std::vector<Levels> one_at_a_time(const Study& study) {
  Levels baseline;
  for (const Factor& factor : study.vary) baseline.push_back(factor.baseline_level());
  std::vector<Levels> runs{baseline};
  for (std::size_t f = 0; f < study.vary.size(); ++f)
    for (int level = 0; level < study.vary[f].levels(); ++level)
      if (level != baseline[f]) {
        runs.push_back(baseline);
        runs.back()[f] = level;
      }
  return runs;
}

}  // namespace

std::vector<Levels> levels_of(const Study& study) {
  return study.design == "product" ? product(study) : one_at_a_time(study);
}

std::string words_of(const Study& study, const Levels& levels, int but) {
  std::string words;
  for (std::size_t f = 0; f < study.vary.size(); ++f) {
    if (static_cast<int>(f) == but) continue;
    const Factor& factor = study.vary[f];
    const std::string unit = factor.labels.empty() ? factor.unit_text() : "";
    words += (words.empty() ? "" : ", ") + factor.name + " " + factor.text(levels[f]) +
             (unit.empty() ? "" : " " + unit);
  }
  return words;
}

std::string size_text(const Study& study) {
  const auto runs = study.combinations();
  std::string factors;
  for (const Factor& f : study.vary)
    factors += fmt::format("{}{} ({})", factors.empty() ? "" : ", ", f.name, f.levels());
  return fmt::format("{} run{}, {}: {}", runs, runs == 1 ? "" : "s",
                     study.design == "product" ? "every combination" : "one factor at a time", factors);
}

double abscissa(const Factor& factor, int level) {
  const auto numbers = factor.numbers();
  return numbers.empty() ? level : numbers[level];
}

std::vector<Line> lines_along(int factor, const Study& study, const std::vector<Levels>& runs) {
  std::vector<Line> lines;
  std::map<Levels, std::size_t> line_of;  // by the levels of the other factors
  for (int run = 0; run < static_cast<int>(runs.size()); ++run) {
    Levels others = runs[run];
    others[factor] = -1;
    const auto [at, fresh] = line_of.try_emplace(others, lines.size());
    if (fresh) lines.push_back({factor, {}});
    lines[at->second].runs.push_back(run);
  }
  std::erase_if(lines, [](const Line& line) { return line.runs.size() < 2; });
  const auto place = [&](int run) { return abscissa(study.vary[factor], runs[run][factor]); };
  for (Line& line : lines) std::ranges::stable_sort(line.runs, {}, place);
  return lines;
}

}  // namespace bulbus::inline app
