#include "app/scene/scene.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include "app/scene/reader.hpp"
#include "app/scene/unused.hpp"
#include "core/problem/idle_keys.hpp"

namespace bulbus::inline app {
namespace {

YamlNode with_overrides(YamlNode root, const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  return root;
}

Scene of_one_run(const YamlNode& root, const std::string& path) {
  Scene scene = scene_of(root, path);
  refuse_unused(root, scene);
  return scene;
}

// Relative files count from the folder of the scene.
void place_files(Scene& scene, const std::string& path) {
  namespace fs = std::filesystem;
  const auto place = [&](std::string& file) {
    file = (fs::absolute(path).parent_path() / file).lexically_normal().string();
  };
  if (scene.mesh.file) place(*scene.mesh.file);
  for (auto& [name, body] : scene.model.rigid_bodies)
    if (body.file) place(body.file->path);
}

// A default that a person writes is meant: the `statistic: mean` of a stress would be its largest value, that
// of a reaction the sum. resolved.yaml writes every key, `percentile` too.
void refuse_idle_mean(const YamlNode& root, const Model& model) {
  const YamlNode* probes = root.find("probes");
  for (std::size_t i = 0; i < model.probes.size(); ++i) {
    const ProbeSpec& probe = model.probes[i];
    const YamlNode& entry = probes->items[i];
    if (has_statistic(probe.kind) || probe.statistic != "mean" || !entry.find("statistic") ||
        entry.find("percentile"))
      continue;
    throw located(
        scene_error("probes." + std::to_string(i) + ".statistic",
                    "has no effect: a probe of the kind " + probe.kind + " has no mean",
                    probe.kind.ends_with("mises")
                        ? "Give `percentile` in its place: 50 is the median, 100 (the default) the largest."
                        : "Leave it out; `bulbus help probes` tells what the kinds are."),
        root);
  }
}

// The records tell steps apart by their names.
void name_by_number(std::vector<StepSpec>& steps) {
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (steps[k].name.empty()) steps[k].name = "step " + std::to_string(k + 1);
}

// Columns of history.csv beside the probes.
const std::set<std::string> columns{"increment",         "step", "time",   "newton_iterations",
                                    "krylov_iterations", "cuts", "seconds"};

template <class Range>
void refuse_twins(const Range& named, const std::string& key) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < named.size(); ++i)
    if (!named[i].name.empty() && !seen.insert(named[i].name).second)
      throw scene_error(key + "." + std::to_string(i) + ".name",
                        "two " + key + " are named '" + named[i].name + "'", "give each its own name");
}

}  // namespace

void Scene::validate() const {
  refuse_twins(model.probes, "probes");
  refuse_twins(model.steps, "steps");
  for (std::size_t i = 0; i < model.probes.size(); ++i) {
    refuse_idle_keys(model.probes[i], "probes." + std::to_string(i));
    if (columns.contains(model.probes[i].name))
      throw scene_error("probes." + std::to_string(i) + ".name",
                        "history.csv has a column '" + model.probes[i].name + "' of its own",
                        "give the probe another name");
  }
  for (std::size_t i = 0; i < model.symmetry.size(); ++i)
    if (std::count(model.symmetry.begin(), model.symmetry.begin() + static_cast<long>(i), model.symmetry[i]) >
        0)
      throw scene_error(
          "symmetry." + std::to_string(i),
          "the plane '" + model.symmetry[i] + "' is given twice: figures of the whole would be doubled",
          "name every plane once");
}

void Scene::take_preset() { solver.linear.take_mesh(mesh.refine); }

Scene scene_of(const YamlNode& root, const std::string& path) {
  Scene scene;
  reader::read(root, parameters_of(scene));
  refuse_idle_mean(root, scene.model);
  place_files(scene, path);
  name_by_number(scene.model.steps);
  return scene;
}

YamlNode scene_data(const std::string& path, const std::vector<std::string>& overrides) {
  return with_overrides(read_yaml(path), overrides);
}

Scene parse_scene(const std::string& text, const std::string& path,
                  const std::vector<std::string>& overrides) {
  return of_one_run(with_overrides(parse_yaml(text, path), overrides), path);
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  return of_one_run(scene_data(path, overrides), path);
}

InputError located(const InputError& fault, const YamlNode& root) {
  if (fault.key.empty()) return fault;
  const Place place = place_of(root, fault.key);
  return input_error(place.file, place.line, fault.key + ": " + fault.what(), "");
}

InputError located(const InputError& fault, const std::string& path,
                   const std::vector<std::string>& overrides) {
  return fault.key.empty() ? fault : located(fault, scene_data(path, overrides));
}

}  // namespace bulbus::inline app
