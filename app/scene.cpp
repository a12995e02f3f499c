#include "app/scene.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "app/reader.hpp"

namespace bulbus {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw input_error(path, 0, "cannot be read", "check the name of the scene file");
  return {std::istreambuf_iterator<char>(in), {}};
}

Entry tree_of(const std::string& text, const std::string& path, const std::vector<std::string>& overrides) {
  Entry root = parse_yaml(text, path);
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

Scene parse_scene(const std::string& text, const std::string& path,
                  const std::vector<std::string>& overrides) {
  Entry root = parse_yaml(text, path);
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  Scene scene;
  reader::read_struct(root, "", scene);
  place_files(scene, path);
  return scene;
}

Scene read_scene(const std::string& path, const std::vector<std::string>& overrides) {
  return parse_scene(text_of(path), path, overrides);
}

InputError located(const InputError& fault, const std::string& path,
                   const std::vector<std::string>& overrides) {
  if (fault.key.empty()) return fault;
  const Place place = place_of(tree_of(text_of(path), path, overrides), fault.key);
  return input_error(place.file, place.line, fault.key + ": " + fault.what(), "");
}

}  // namespace bulbus
