#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "app/scene/unused.hpp"
#include "app/study/study_source.hpp"
#include "core/base/did_you_mean.hpp"

namespace bulbus::inline app {
namespace {

/// What some runs of a study give without effect: the other factors may choose a method that has no use for
/// it. What no run uses is a slip.
struct UnusedInAll {
  struct Setting {
    int runs = 0, first = 0;  ///< that give it so; the first of them that needs telling
    std::optional<InputError> fault;
  };
  std::map<std::string, Setting> settings;
  int run = 0;

  void add(const std::vector<UnusedSetting>& unused) {
    for (const UnusedSetting& u : unused) {
      Setting& setting = settings[u.key];
      ++setting.runs;
      if (u.differs() && !setting.fault) setting.fault = u.fault(), setting.first = run;
    }
    ++run;
  }
};

// Where a setting has no effect, the run has the value that it would have without.
Scene scene_of_run(const Study& study, const Levels& levels, UnusedInAll& all) {
  YamlNode root = source_of(study, levels);
  const Scene scene = scene_of(root, study.scene);
  const auto unused = unused_settings(root, scene);
  all.add(unused);
  for (const UnusedSetting& u : unused) set_at(root, u.key, {}, YamlNode::word(u.otherwise));
  return unused.empty() ? scene : scene_of(root, study.scene);
}

const ProbeSpec* probe(const StudyRun& run, const std::string& name) {
  const auto& probes = run.scene.model.probes;
  const auto at = std::ranges::find(probes, name, &ProbeSpec::name);
  return at == probes.end() ? nullptr : &*at;
}

std::vector<std::string> probe_names(const StudyRun& run) {
  std::vector<std::string> names;
  for (const ProbeSpec& p : run.scene.model.probes) names.push_back(p.name);
  return names;
}

void expect_figure(const std::string& name, const StudyRun& run, const StudyRun& first) {
  const ProbeSpec *here = probe(run, name), *there = probe(first, name);
  if (!here)
    throw scene_error("figures", "there is no probe '" + name + "'",
                      did_you_mean(name, probe_names(run), "name probes of the scene"));
  if (here->unit != there->unit || here->label != there->label || here->kind != there->kind)
    throw scene_error("figures",
                      "'" + name + "' is another figure, or in another unit, than in the first run",
                      "vary neither kind nor unit of a probe");
}

}  // namespace

InputError fault_of(const InputError& fault, const Study& study, const StudyRun& run) {
  const InputError placed = fault.key.empty() ? fault : located(fault, source_of(study, run.levels));
  return InputError(fmt::format("{}\n  in {}: {}", placed.what(), run.name, words_of(study, run.levels)));
}

std::vector<StudyRun> plan(const Study& study) {
  std::vector<StudyRun> runs;
  UnusedInAll unused;
  for (const Levels& levels : levels_of(study)) {
    runs.push_back({fmt::format("run_{:03d}", runs.size() + 1), levels, {}});
    StudyRun& run = runs.back();
    if (runs.size() == 1) refuse_overwritten(study, run);
    of_run(study, run, [&] { run.scene = scene_of_run(study, levels, unused); });
  }
  for (const auto& [key, setting] : unused.settings)
    if (setting.runs == static_cast<int>(runs.size()) && setting.fault)
      throw fault_of(*setting.fault, study, runs[setting.first]);
  return runs;
}

std::vector<std::string> figures_of(const Study& study, const std::vector<StudyRun>& runs) {
  const std::vector<std::string> figures = study.figures.empty() ? probe_names(runs[0]) : study.figures;
  try {
    for (const StudyRun& run : runs)
      for (const std::string& name : figures) expect_figure(name, run, runs[0]);
  } catch (const InputError& fault) {
    throw located(fault, study.source);
  }
  return figures;
}

}  // namespace bulbus::inline app
