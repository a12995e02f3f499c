#include <fmt/format.h>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/records/record_names.hpp"
#include "app/report/html.hpp"
#include "app/report/page.hpp"
#include "app/report/report.hpp"
#include "core/base/error.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline app {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::string level_of(const json& value) {
  return value.is_number()   ? html::number(value)
         : value.is_string() ? html::escaped(value.get<std::string>())
                             : value.dump();
}

// The run's name, linked to its report, which is made anew; the name alone where its files are gone.
std::string run_link(const std::string& folder, const std::string& run) {
  try {
    write_report(folder + "/" + run, "", "");
  } catch (const InputError&) {
    return html::escaped(run);
  }
  return html::link(run + "/" + report_file, run);
}

std::string runs_table(const json& study, const std::string& folder) {
  html::Table table{{"run"}, {}, 1};
  for (const json& factor : study.at("factors")) {
    const std::string unit = factor.value("unit", "");
    table.header.push_back(
        html::escaped(factor.at("name").get<std::string>() + (unit.empty() ? "" : " [" + unit + "]")));
  }
  table.header.push_back("converged");
  for (const auto& [name, unit] : study.at("units").items())
    table.header.push_back(html::escaped(name + (unit == "" ? "" : " [" + html::unit(unit) + "]")));
  for (const json& run : study.at("runs")) {
    std::vector<std::string> row{run_link(folder, run.at("run"))};
    for (const json& factor : study.at("factors"))
      row.push_back(level_of(run.at("factors").at(factor.at("name").get<std::string>())));
    row.push_back(run.at("converged") ? "yes" : "no");
    for (const auto& [name, unit] : study.at("units").items()) {
      const json& value = run.at("probes").at(name);
      row.push_back(value.is_number() ? html::number(value) : "–");
    }
    table.rows.push_back(row);
  }
  return html::table(table);
}

std::string trends_of_study(const json& study) {
  std::string items;
  for (const json& trend : study.value("trends", json::array()))
    if (trend.value("course", "") == "not monotone")
      items += html::text("li", fmt::format("{} does not go one way along {}.", trend.value("figure", ""),
                                            trend.value("factor", "")));
  return items.empty() ? "" : html::element("ul", items);
}

}  // namespace

std::string study_report(const std::string& folder) {
  const json study = json::parse(content_of(fs::path(folder) / study_file), nullptr, false);
  if (!study.is_object() || !study.contains("runs"))
    throw input_error(folder + "/" + study_file, 0, "is no record of a study", "Run the study again.");
  const std::string title = study.value("title", "").empty() ? folder : study.value("title", ""),
                    figure = content_of(fs::path(folder) / "study.svg");
  std::size_t converged = 0;
  for (const json& run : study.at("runs")) converged += run.value("converged", false) ? 1 : 0;
  const std::string verdict =
      fmt::format("{} of {} runs converged.", converged, study.value("runs_planned", 0));
  const bool all = converged == study.value("runs_planned", 0U);
  Page page{title, "", {}};
  page.body = heading_of(title, {{"runs", "Runs"}, {"figure", "Figure"}}) +
              html::text("p", verdict, all ? "verdict good" : "verdict bad") + trends_of_study(study) +
              html::section("runs", "Runs", runs_table(study, folder)) +
              html::section(
                  "figure", "Figure",
                  html::element("div", figure.substr(std::min(figure.find("<svg"), figure.size())), "wide"));
  return html_of(page);
}

}  // namespace bulbus::inline app
