#include "app/records/finished.hpp"

#include <nlohmann/json.hpp>

#include "app/eye/tissues.hpp"
#include "app/scene/input_files.hpp"
#include "app/version.hpp"
#include "core/io/text_file.hpp"
#include "core/solve/march.hpp"

namespace bulbus::inline app {
namespace {

using json = nlohmann::json;

// None if there is no such file, or nothing but a ruin.
std::vector<std::string> regions_in(const std::string& resolved) {
  try {
    const YamlNode root = parse_yaml(resolved, "resolved.yaml");
    const YamlNode* regions = root.find("regions");
    return regions ? regions->keys : std::vector<std::string>();
  } catch (const InputError&) {
    return {};
  }
}

// resolved.yaml gives the regions that `materials` stands for one by one.
bool is_of(const std::string& resolved, Scene scene) {
  add_tissues(scene.materials, regions_in(resolved), scene.model);
  return resolved == resolved_yaml(scene);
}

}  // namespace

json summary_in(const std::string& folder) {
  return json::parse(content_of(folder + "/summary.json"), nullptr, false);
}

bool was_interrupted(const json& summary) {
  return summary.is_object() && summary.value("reason", "") == describe(Outcome::interrupted);
}

bool is_finished(const Scene& scene, const std::string& folder) {
  const json summary = summary_in(folder);
  return summary.is_object() && !was_interrupted(summary) &&
         summary.value("reason", "").find(out_of_memory) == std::string::npos &&
         summary.value("/versions/bulbus"_json_pointer, "") == version &&
         is_of(content_of(folder + "/resolved.yaml"), scene) &&
         summary.value("input_files", json::object()) == hashes_of(input_files(scene));
}

}  // namespace bulbus::inline app
