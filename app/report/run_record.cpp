#include "app/report/run_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/records/finished.hpp"
#include "app/records/record_names.hpp"
#include "core/base/error.hpp"
#include "core/io/text_file.hpp"

namespace bulbus::inline app {
namespace {

using json = nlohmann::json;

std::optional<Scene> scene_in(const std::string& text, const std::string& path) {
  try {
    return parse_scene(text, path);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

// Pseudo-time counts finished steps: 1.25 is a quarter into the second.
std::string label_of(double time, const History& history) {
  if (time == 0) return "before any load";
  const auto row = std::ranges::find_if(
      history.increments, [&](const History::Row& r) { return std::abs(r.time - time) < 1e-9; });
  const double begun = std::ceil(time - 1e-9) - 1;
  const std::string part = fmt::format("{:.3g} %", 100 * (time - begun));
  if (row == history.increments.end() || row->step.empty())
    return fmt::format("step {:g}, {}", begun + 1, part);
  return time - begun > 1 - 1e-9 ? "end of " + row->step : row->step + ", " + part;
}

std::vector<RunRecord::Frame> frames_in(const std::string& folder, const History& history) {
  const json index = json::parse(content_of(folder + "/" + series_file), nullptr, false);
  std::vector<RunRecord::Frame> frames;
  if (!index.is_object()) return frames;
  for (const json& file : index.value("files", json::array())) {
    const int increment = increment_of(file.value("name", ""));
    const double time = file.value("time", 0.);
    if (increment >= 0) frames.push_back({increment, time, label_of(time, history)});
  }
  return frames;
}

}  // namespace

std::string RunRecord::title() const {
  const std::string title = summary.value("title", scene ? scene->title : "");
  return title.empty() ? folder : title;
}

const ProbeSpec* RunRecord::probe(const std::string& name) const {
  if (!scene) return nullptr;
  const auto found = std::ranges::find(scene->model.probes, name, &ProbeSpec::name);
  return found == scene->model.probes.end() ? nullptr : &*found;
}

std::string RunRecord::unit(const std::string& probe) const { return history.unit(probe); }

RunRecord read_run(const std::string& folder) {
  RunRecord run{.folder = folder, .summary = summary_in(folder)};
  if (!run.summary.is_object()) run.summary = json::object();
  const bool has_history = std::filesystem::exists(folder + "/" + history_file);
  if (!has_history) refuse_study_folder(folder);
  if (!has_history && run.summary.empty())
    throw input_error(folder, 0, "has neither history.csv nor summary.json",
                      "Name the folder of the results of a run or of a study.");
  if (has_history) run.history = read_history(folder);
  run.scene_text = content_of(folder + "/" + resolved_file);
  run.log_text = content_of(folder + "/" + log_file);
  run.scene = scene_in(run.scene_text, folder + "/" + resolved_file);
  run.frames = frames_in(folder, run.history);
  return run;
}

}  // namespace bulbus::inline app
