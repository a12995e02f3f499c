#include "app/study/study_json.hpp"

#include <nlohmann/json.hpp>

namespace bulbus::inline app {
namespace {

using json = nlohmann::json;

json value_of(const Factor& factor, int level) {
  const auto numbers = factor.numbers();
  return numbers.empty() ? json(factor.text(level)) : json(numbers[level]);
}

json factor_json(const Factor& factor) {
  json f{{"name", factor.name},
         {"unit", factor.unit_text()},
         {"keys", factor.keys},
         {"labels", factor.labels},
         {"values", json::array()}};
  for (int level = 0; level < factor.levels(); ++level) f["values"].push_back(value_of(factor, level));
  return f;
}

// The values of the factors, without that along which a line runs.
json levels_json(const Study& study, const Levels& levels, int but = -1) {
  json values = json::object();
  for (int f = 0; f < static_cast<int>(study.vary.size()); ++f)
    if (f != but) values[study.vary[f].name] = value_of(study.vary[f], levels[f]);
  return values;
}

json run_json(const Study& study, const StudyResults& results, int run) {
  const StudyRow& row = *results.rows[run];
  json probes = json::object();
  for (std::size_t i = 0; i < row.values.size(); ++i)
    probes[results.figures[i].name] = row.values[i] ? json(*row.values[i]) : json();
  return {{"run", results.runs[run]},
          {"factors", levels_json(study, results.levels[run])},
          {"converged", row.converged},
          {"reason", row.reason},
          {"probes", probes},
          {"newton_iterations", row.newton_iterations},
          {"krylov_iterations", row.krylov_iterations},
          {"seconds", row.seconds}};
}

json trend_json(const Study& study, const StudyResults& results, const Trend& trend) {
  json runs = json::array(), turns = json::array();
  for (int run : trend.runs) runs.push_back(results.runs[run]);
  for (int t : trend.course.turns)
    turns.push_back(
        value_of(study.vary[trend.line.factor], results.levels[trend.runs[t]][trend.line.factor]));
  return {{"factor", study.vary[trend.line.factor].name},
          {"figure", results.figures[trend.figure].name},
          {"others", levels_json(study, results.levels[trend.line.runs[0]], trend.line.factor)},
          {"course", name_of(trend.course.kind)},
          {"turns", turns},
          {"converged_runs", runs},
          {"runs", trend.line.runs.size()}};
}

}  // namespace

json json_of(const Study& study, const StudyResults& results, const std::vector<Trend>& trends) {
  json s{{"title", study.title},     {"scene", study.scene},
         {"design", study.design},   {"runs_planned", results.runs.size()},
         {"factors", json::array()}, {"units", json::object()},
         {"runs", json::array()},    {"trends", json::array()}};
  for (const Factor& factor : study.vary) s["factors"].push_back(factor_json(factor));
  for (const auto& figure : results.figures) s["units"][figure.name] = figure.unit;
  for (int run = 0; run < static_cast<int>(results.runs.size()); ++run)
    if (results.rows[run]) s["runs"].push_back(run_json(study, results, run));
  for (const Trend& trend : trends) s["trends"].push_back(trend_json(study, results, trend));
  return s;
}

}  // namespace bulbus::inline app
