#include "app/records/record_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "core/base/error.hpp"
#include "core/solve/march.hpp"

namespace bulbus::inline app {

std::string result_file(int increment) { return fmt::format("result_{:04d}.hdf", increment); }
std::string bodies_file(int increment) { return fmt::format("bodies_{:04d}.vtp", increment); }
std::string lines_file(int increment) { return fmt::format("lines_{:04d}.vtp", increment); }

int increment_of(const std::string& name) {
  const auto bar = name.find('_');
  const int number = bar == std::string::npos ? -1 : std::atoi(name.c_str() + bar + 1);
  const bool known = name == result_file(number) || name == bodies_file(number) || name == lines_file(number);
  return number >= 0 && known ? number : -1;
}

bool is_continued(const std::string& name) {
  static const std::set<std::string> names{history_file, krylov_file,  log_file,
                                           series_file,  bodies_index, lines_index};
  return names.contains(name);
}

bool RecordNames::contains(const std::string& name) const {
  const int increment = increment_of(name);
  return names.contains(name) || (increment >= 0 && increment <= increments);
}

RecordNames record_names(const Scene& scene) {
  RecordNames records{{summary_file, history_file, units_file, resolved_file, log_file, checkpoint_file}};
  if (scene.reference) records.names.insert(unloaded_file);
  const LinearSettings& linear = scene.solver.linear;
  if (linear.record_krylov || linear.record_spectrum) records.names.insert(krylov_file);
  if (scene.output.report) records.names.insert(report_file);
  if (!scene.output.vtk) return records;
  records.names.insert({series_file, bodies_index, lines_index});
  records.increments = 0;
  for (const StepSpec& step : scene.model.steps)
    records.increments += increments_of(step, scene.solver.stepping);
  return records;
}

void refuse_study_folder(const std::string& folder) {
  if (std::filesystem::exists(std::filesystem::path(folder) / study_file))
    throw input_error(
        folder, 0, "is the folder of a study, not of a run",
        "Name one of its runs, such as " + (std::filesystem::path(folder) / "run_001").string() + ".");
}

void refuse_outside(const Scene& scene) {
  const std::filesystem::path dump = scene.solver.linear.dump;
  const bool control = std::ranges::any_of(dump.string(), [](unsigned char c) { return c < ' '; });
  if (dump.is_absolute() || std::ranges::count(dump, std::filesystem::path("..")) > 0 || control)
    throw scene_error("solver.linear.dump", "'" + dump.string() + "' is no folder within that of the results",
                      "Give it a plain name: 'systems' becomes a folder beside run.log.");
  if (!dump.empty() && record_names(scene).contains(dump.begin()->string()))
    throw scene_error("solver.linear.dump", "'" + dump.string() + "' is the name of a record",
                      "Give it another: 'systems'.");
}

}  // namespace bulbus::inline app
