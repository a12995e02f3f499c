#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/commands.hpp"
#include "app/records/history.hpp"
#include "app/study/study_results.hpp"
#include "core/base/error.hpp"

namespace bulbus::inline app {
namespace {

// Steps end at the same time if they differ by no more than this.
constexpr double same_time = 1e-9;

// A line of the table: the figures of both runs; none where a run does not know one.
struct Figure {
  std::string step, probe, unit;
  std::optional<double> first, second;
  double largest = 0;  // magnitude of the probe in both runs
  double difference() const { return *second - *first; }
  double relative() const { return largest > 0 ? difference() / largest : 0; }
};

bool differs(const Figure& f, const CompareOptions& options) {
  if (!f.first || !f.second) return f.first.has_value() != f.second.has_value();
  const double size = std::abs(f.difference());
  return !(size <= options.absolute || size <= options.relative * f.largest);
}

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
               std::optional<double>& value, Figure& figure) {
  const auto at = std::ranges::find(history.probes, probe) - history.probes.begin();
  const History::Row* end = end_of(history, step);
  if (!end || at == std::ssize(history.probes)) return;
  value = end->values[at];
  figure.largest = std::max(figure.largest, history.largest[at]);
  if (const auto unit = history.units.find(probe); unit != history.units.end()) figure.unit = unit->second;
}

// Of every step its time, where the two ends are not the same, and its probes.
std::vector<Figure> figures_of(const History& a, const History& b) {
  std::vector<Figure> figures;
  for (const std::string& step : united(steps_of(a), steps_of(b))) {
    const History::Row *one = end_of(a, step), *other = end_of(b, step);
    Figure time{.step = step, .probe = "time", .largest = 1};
    if (one) time.first = one->time;
    if (other) time.second = other->time;
    if (!one || !other || std::abs(time.difference()) > same_time) figures.push_back(time);
    for (const std::string& probe : united(a.probes, b.probes)) {
      Figure figure{.step = step, .probe = probe};
      add_probe(a, step, probe, figure.first, figure);
      add_probe(b, step, probe, figure.second, figure);
      figures.push_back(figure);
    }
  }
  return figures;
}

std::string text_of(const std::optional<double>& value) {
  return value ? fmt::format("{:.7g}", *value) : "-";
}

std::vector<std::string> table_of(const std::vector<Figure>& figures, const CompareOptions& options) {
  std::vector<std::vector<std::string>> columns{{"step", ""},     {"probe", ""},  {"unit", ""},
                                                {"first", ""},    {"second", ""}, {"difference", ""},
                                                {"relative", ""}, {"", ""}};
  for (const Figure& f : figures) {
    const bool both = f.first && f.second;
    const std::vector<std::string> row{f.step,
                                       f.probe,
                                       f.unit,
                                       text_of(f.first),
                                       text_of(f.second),
                                       both ? fmt::format("{:.2e}", f.difference()) : "-",
                                       both ? fmt::format("{:.2e}", f.relative()) : "-",
                                       differs(f, options) ? "differs" : ""};
    for (std::size_t c = 0; c < row.size(); ++c) columns[c].push_back(row[c]);
  }
  return aligned(columns, static_cast<int>(columns.size()) - 1);
}

}  // namespace

int compare(const std::string& first, const std::string& second, const CompareOptions& options,
            std::ostream& out) {
  const History a = read_history(first), b = read_history(second);
  refuse_other_units(a, b);
  const std::vector<Figure> figures = figures_of(a, b);
  if (figures.empty())
    throw input_error("the two histories have no figures", "give the scenes probes, and run them");
  const auto different = std::ranges::count_if(figures, [&](const Figure& f) { return differs(f, options); });
  out << "first: " << first << "\nsecond: " << second << "\n";
  for (const std::string& line : table_of(figures, options)) out << line << "\n";
  out << fmt::format("{} of {} figures differ by more than {:g} of the probe's largest value{}\n", different,
                     figures.size(), options.relative,
                     options.absolute > 0 ? fmt::format(" and {:g}", options.absolute) : "");
  return different > 0 ? 1 : 0;
}

}  // namespace bulbus::inline app
