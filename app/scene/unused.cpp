#include "app/scene/unused.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/scene/reader.hpp"
#include "app/scene/schema_tree.hpp"
#include "app/scene/writer.hpp"
#include "core/base/require_one.hpp"

namespace bulbus::inline app {
namespace {

// "solver.linear.gamma" is "solver" and "linear.gamma"; the second may be empty.
std::pair<std::string, std::string> head_and_rest(const std::string& path) {
  const auto dot = path.find('.');
  return {path.substr(0, dot), dot == std::string::npos ? "" : path.substr(dot + 1)};
}

std::string word_at(const YamlNode& map, const std::string& path) {
  const auto [name, rest] = head_and_rest(path);
  const YamlNode* entry = map.find(name);
  return !entry ? "" : rest.empty() ? entry->text : word_at(*entry, rest);
}

void remove(YamlNode& map, const std::string& path) {
  const auto [name, rest] = head_and_rest(path);
  YamlNode* entry = map.find(name);
  if (!entry) return;
  if (!rest.empty()) return remove(*entry, rest);
  const auto at = entry - map.items.data();
  map.items.erase(map.items.begin() + at);
  map.keys.erase(map.keys.begin() + at);
  map.key_places.erase(map.key_places.begin() + at);
}

YamlNode written(Scene scene) { return entry_of(parameters_of(scene)); }

// What `auto` stands for is what conditions ask for.
YamlNode choices_of(Scene scene) {
  LinearSettings& linear = scene.solver.linear;
  linear.displacement = linear.displacement_on(scene.mesh.refine > 0);
  return written(std::move(scene));
}

// "auto, here aggregation"
std::string chosen_at(const YamlNode& values, const YamlNode& choices, const std::string& key) {
  const std::string given = word_at(values, key), chosen = word_at(choices, key);
  return given == chosen ? given : given + ", here " + chosen;
}

struct Read {
  YamlNode values, choices;
};

void collect(const SchemaNode& group, const YamlNode& given, const std::string& path, const Read& read,
             std::vector<UnusedSetting>& unused) {
  for (const SchemaNode& t : group.parts) {
    const YamlNode* entry = given.find(t.key);
    if (!entry) continue;
    const std::string key = reader::below(path, t.key);
    if (t.kind == SchemaNode::Kind::group) {
      collect(t, *entry, key, read, unused);
      continue;
    }
    const auto holds = [&](const Condition& c) {
      return std::ranges::find(c.words, word_at(read.choices, c.key)) != c.words.end();
    };
    const auto& conditions = t.about.conditions;
    if (const auto failed = std::ranges::find_if_not(conditions, holds); failed != conditions.end())
      unused.push_back(
          {key, *failed, chosen_at(read.values, read.choices, failed->key), word_at(read.values, key), ""});
  }
}

Scene without(const std::vector<UnusedSetting>& unused, YamlNode root) {
  for (const UnusedSetting& u : unused) remove(root, u.key);
  Scene scene;
  reader::read(root, parameters_of(scene));
  return scene;
}

}  // namespace

InputError UnusedSetting::fault() const {
  return scene_error(
      key, fmt::format("has no effect: {} is {}", condition.key, chosen),
      fmt::format("Leave it out, or choose {} for {}.", alternatives(condition.words), condition.key));
}

std::vector<UnusedSetting> unused_settings(const YamlNode& root, const Scene& scene) {
  std::vector<UnusedSetting> unused;
  Scene defaults;
  collect(schema_tree_of("", About{""}, parameters_of(defaults)), root, "",
          {written(scene), choices_of(scene)}, unused);
  if (unused.empty()) return unused;
  const YamlNode others = written(without(unused, root));
  for (UnusedSetting& u : unused) u.otherwise = word_at(others, u.key);
  return unused;
}

void refuse_unused(const YamlNode& root, const Scene& scene) {
  for (const UnusedSetting& u : unused_settings(root, scene))
    if (u.differs()) throw located(u.fault(), root);
}

}  // namespace bulbus::inline app
