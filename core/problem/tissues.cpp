#include "core/problem/tissues.hpp"

namespace bulbus {

std::optional<double> tissue_stiffness(const std::string& materials, const std::string& tissue) {
  static const std::map<std::string, double> paper{
      {"cornea", .0333},    {"sclera", .0833}, {"ciliary_body", .01}, {"choroid", .0083}, {"retina", .0008},
      {"optic_nerve", .05}, {"lens", 1}};
  const auto found = paper.find(tissue);
  if (materials == "none" || found == paper.end()) return {};
  if (tissue == "lens") return materials == "stiff_lens" ? 100 : found->second;
  return materials == "physiological" ? 6 * found->second : found->second;
}

void add_tissues(Model& model, const std::vector<std::string>& regions) {
  for (const std::string& name : regions)
    if (const auto c10 = tissue_stiffness(model.materials, name); c10 && !model.regions.contains(name))
      model.regions[name].c10 = *c10;
}

}  // namespace bulbus
