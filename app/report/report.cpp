#include "app/report/report.hpp"

#include <filesystem>

#include "app/records/record_names.hpp"
#include "app/report/html.hpp"
#include "app/report/model_json.hpp"
#include "app/report/page.hpp"
#include "app/report/sections.hpp"
#include "core/base/error.hpp"
#include "core/io/manifest.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline app {
namespace {

namespace fs = std::filesystem;

// Of scripts, style and the figures, which are not thinned out.
constexpr double bytes_besides = 1.2e6;

double room_of(const RunRecord& run) {
  return most_bytes - bytes_besides - static_cast<double>(run.scene_text.size() + run.log_text.size());
}

// Damaged files are the input of a report.
nlohmann::json model_of(const RunRecord& run, double room) {
  try {
    return model_json(run, room);
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& fault) {
    throw input_error(run.folder, 0, fault.what(), "Run the scene again.");
  }
}

// The place of the model `number` of the page.
std::string view_of(const nlohmann::json& model, const std::string& caption) {
  if (model.is_null()) return html::text("p", "There are no result files to draw.");
  std::string notes;
  for (const auto& note : model.at("notes")) notes += note.get<std::string>() + " ";
  const std::string note = notes.empty() ? "" : html::text("p", notes, "note");
  return "<figure class=\"view\">" + (caption.empty() ? "" : html::text("figcaption", caption)) +
         "<div class=\"canvas\"></div>" + note + "</figure>\n";
}

std::string model_section(const std::string& views, bool drawn) {
  constexpr const char* below =
      "<p id=\"told\" aria-live=\"polite\">A click on the model tells what is there. Drag to turn, wheel to "
      "zoom, right button to move; on the keyboard arrows, plus and minus.</p>\n<div id=\"legend\"></div>\n";
  return html::section(
      "model", "Model",
      "<div id=\"controls\"></div>\n" + html::element("div", views, "views") + (drawn ? below : ""));
}

// Lists the page among the records of its folder, which a later run may take away.
void claim(const fs::path& file) {
  const std::string folder = file.parent_path().string(), name = file.filename().string();
  if (!fs::exists(fs::path(folder) / "manifest.txt")) return;
  Manifest manifest(folder);
  if (fs::exists(file) && !manifest.lists(name))
    throw input_error(file.string(), 0, "is there, and no run wrote it",
                      "Move it away, or name another file with -o.");
  manifest.add({name});
}

bool is_of_a_study(const std::string& folder) { return fs::exists(fs::path(folder) / study_file); }

}  // namespace

std::string run_report(const std::string& folder) {
  const RunRecord run = read_run(folder);
  Page page{run.title(), "", {}};
  const nlohmann::json model = model_of(run, room_of(run));
  page.body =
      heading_of(run.title(), {{"model", "Model"},
                               {"figures", "Figures"},
                               {"histories", "Histories"},
                               {"cost", "Convergence and cost"},
                               {"records", "Scene and log"}}) +
      html::element("section", conclusions_of(run)) + model_section(view_of(model, ""), !model.is_null()) +
      html::section("figures", "Figures", figures_of(run)) +
      html::section("histories", "Histories", histories_of(run)) +
      html::section("cost", "Convergence and cost", cost_of(run)) +
      html::section("records", "Scene and log", records_of(run)) + html::element("footer", origin_of(run));
  if (!model.is_null()) page.models.push_back(model);
  return html_of(page);
}

std::string comparison_report(const std::string& first, const std::string& second) {
  const RunRecord a = read_run(first), b = read_run(second);
  const double room = (most_bytes - bytes_besides) / 2;
  Page page{"Comparison of " + first + " and " + second, "", {}};
  std::string views;
  for (const RunRecord* run : {&a, &b}) {
    const nlohmann::json model = model_of(*run, room);
    views += view_of(model, (run == &a ? "first: " : "second: ") + run->folder);
    if (!model.is_null()) page.models.push_back(model);
  }
  const Differences differences = differences_of(a, b);
  page.body = heading_of(page.title, {{"model", "Models"}, {"differences", "Differences"}}) +
              differences.verdict + model_section(views, !page.models.empty()) +
              html::section("differences", "Differences", differences.table) +
              html::element("footer", origin_of(a) + origin_of(b));
  return html_of(page);
}

std::string write_report(const std::string& folder, const std::string& second, const std::string& file) {
  const bool study = second.empty() && is_of_a_study(folder);
  const fs::path path =
      !file.empty() ? fs::path(file) : fs::path(folder) / (second.empty() ? report_file : comparison_file);
  if (file.empty()) claim(path);
  const std::string page = study            ? study_report(folder)
                           : second.empty() ? run_report(folder)
                                            : comparison_report(folder, second);
  write_whole(path.string(), page);
  return path.string();
}

}  // namespace bulbus::inline app
