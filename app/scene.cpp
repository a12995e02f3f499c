#include "app/scene.hpp"

#include <filesystem>
#include <set>

#include "app/reader.hpp"

namespace bulbus {
namespace {

Entry with_overrides(Entry root, const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  return root;
}

// Relative files count from the folder of the scene.
void place_files(Scene& scene, const std::string& path) {
  namespace fs = std::filesystem;
  const auto place = [&](std::string& file) { file = (fs::absolute(path).parent_path() / file).lexically_normal().string(); };
  if (scene.mesh.file) place(*scene.mesh.file);
  for (auto& [name, body] : scene.model.rigid_bodies)
    if (body.file) place(body.file->path);
}

template <class Range>
void refuse_twins(const Range& named, const std::string& what) {
  std::set<std::string> seen;
  for (const auto& item : named)
    if (!item.name.empty() && !seen.insert(item.name).second)
      throw input_error("two " + what + " are named '" + item.name + "'", "give each its own name");
}

}  // namespace

void Scene::validate() const {
  refuse_twins(model.probes, "probes");
  refuse_twins(model.steps, "steps");
}

void Scene::take_preset() { solver.linear.take_mesh(mesh.refine); }

Scene scene_of(const Entry& root, const std::string& path) {
  Scene scene;
  reader::read_struct(root, "", scene);
  place_files(scene, path);
  return scene;
}

Scene parse_scene(const std::string& text, const std::string& path,
                  const std::vector<std::string>& overrides) {
  return scene_of(with_overrides(parse_yaml(text, path), overrides), path);
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  return scene_of(with_overrides(read_yaml(path), overrides), path);
}

InputError located(const InputError& fault, const Entry& root) {
  if (fault.key.empty()) return fault;
  const Place place = place_of(root, fault.key);
  return input_error(place.file, place.line, fault.key + ": " + fault.what(), "");
}

InputError located(const InputError& fault, const std::string& path,
                   const std::vector<std::string>& overrides) {
  return fault.key.empty() ? fault : located(fault, with_overrides(read_yaml(path), overrides));
}

}  // namespace bulbus
