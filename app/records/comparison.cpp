#include "app/records/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace bulbus::inline app {
namespace {

// Steps end at the same time if they differ by no more than this.
constexpr double same_time = 1e-9;

const History::Row* end_of(const History& history, const std::string& step) {
  const auto found = std::ranges::find(history.ends, step, &History::Row::step);
  return found == history.ends.end() ? nullptr : &*found;
}

std::vector<std::string> united(std::vector<std::string> names, const std::vector<std::string>& more) {
  for (const std::string& name : more)
    if (std::ranges::count(names, name) == 0) names.push_back(name);
  return names;
}

void refuse_other_units(const History& a, const History& b) {
  for (const auto& [probe, unit] : a.units)
    if (const auto other = b.units.find(probe); other != b.units.end() && other->second != unit)
      throw input_error(fmt::format("the probe '{}' is in '{}' in the first run and in '{}' in the second",
                                    probe, unit, other->second),
                        "give it the same `unit` in both scenes");
}

std::vector<std::string> steps_of(const History& history) {
  std::vector<std::string> steps;
  for (const History::Row& end : history.ends) steps.push_back(end.step);
  return steps;
}

void add_probe(const History& history, const std::string& step, const std::string& probe,
               std::optional<double>& value, ComparedFigure& figure) {
  const auto at = std::ranges::find(history.probes, probe) - history.probes.begin();
  const History::Row* end = end_of(history, step);
  if (!end || at == std::ssize(history.probes)) return;
  value = end->values[at];
  figure.largest = std::max(figure.largest, history.largest[at]);
  figure.unit = history.unit(probe);
}

}  // namespace

std::vector<ComparedFigure> compared_figures(const History& a, const History& b) {
  refuse_other_units(a, b);
  std::vector<ComparedFigure> figures;
  for (const std::string& step : united(steps_of(a), steps_of(b))) {
    const History::Row *one = end_of(a, step), *other = end_of(b, step);
    ComparedFigure time{.step = step, .probe = "time", .largest = 1};
    if (one) time.first = one->time;
    if (other) time.second = other->time;
    if (!one || !other || std::abs(time.difference()) > same_time) figures.push_back(time);
    for (const std::string& probe : united(a.probes, b.probes)) {
      ComparedFigure figure{.step = step, .probe = probe};
      add_probe(a, step, probe, figure.first, figure);
      add_probe(b, step, probe, figure.second, figure);
      if (figure.first || figure.second) figures.push_back(figure);
    }
  }
  if (figures.empty())
    throw input_error("the two histories have no figures", "give the scenes probes, and run them");
  return figures;
}

std::string ComparedFigure::verdict(const CompareOptions& options) const {
  if (!second) return "only in the first";
  if (!first) return "only in the second";
  return differs(options) ? "differs" : "";
}

bool ComparedFigure::differs(const CompareOptions& options) const {
  if (!first || !second) return true;
  const double size = std::abs(difference());
  return !(size <= options.absolute || size <= options.relative * largest);
}

}  // namespace bulbus::inline app
