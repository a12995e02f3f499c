#include "app/eye/tissues.hpp"

#include <algorithm>
#include <map>

#include "core/base/error.hpp"

namespace bulbus::inline eye {

std::optional<double> tissue_stiffness(const std::string& materials, const std::string& tissue) {
  static const std::map<std::string, double> paper{
      {"cornea", .0333},    {"sclera", .0833}, {"ciliary_body", .01}, {"choroid", .0083}, {"retina", .0008},
      {"optic_nerve", .05}, {"lens", 1}};
  const auto found = paper.find(tissue);
  if (materials == "none" || found == paper.end()) return {};
  if (tissue == "lens") return materials == "stiff_lens" ? 100 : found->second;
  return materials == "physiological" ? 6 * found->second : found->second;
}

void add_tissues(const std::string& materials, const std::vector<std::string>& regions, Model& model) {
  for (const std::string& name : regions)
    if (const auto c10 = tissue_stiffness(materials, name); c10 && !model.regions.contains(name))
      model.regions[name].c10 = *c10;
}

void require_tissues(const std::vector<std::string>& regions, const Model& model) {
  const auto in_mesh = [&](const auto& region) { return std::ranges::count(regions, region.first) > 0; };
  if (!std::ranges::all_of(model.regions, in_mesh)) return;
  for (const std::string& name : regions)
    if (!model.regions.contains(name) && tissue_stiffness("paper", name))
      throw scene_error("regions", "region '" + name + "' of the mesh has no material",
                        "Add `" + name + ": {c10: ...}` under `regions`, or say `materials: paper`.");
}

}  // namespace bulbus::inline eye
