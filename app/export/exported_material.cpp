#include "app/export/exported_material.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/problem/region_material.hpp"

namespace bulbus::inline app {

int ExportedMaterial::order() const {
  int largest = 0;
  for (const auto& [powers, value] : c) largest = std::max(largest, powers.first + powers.second);
  return largest;
}

double ExportedMaterial::coefficient(int r, int s) const {
  const auto at = c.find({r, s});
  return at == c.end() ? 0 : at->second;
}

double ExportedMaterial::shear() const { return 2 * (coefficient(1, 0) + coefficient(0, 1)); }

void refuse_unwritten_laws(const Model& model) {
  for (const auto& [region, law] : model.regions)
    if (!is_polynomial(material_of(law)))
      throw scene_error(
          "regions." + region,
          "a law that is no polynomial of I1 and I2, such as `fung` or `fibres`, has no equivalent in the "
          "file",
          "Give its coefficients c10 ... c30, or a format's own law by hand in the mesh alone (.msh).");
}

ExportedMaterial exported_material(const RegionSpec& spec) {
  ExportedMaterial material;
  for (const auto& term : terms_of(spec)) material.c[{term.r, term.s}] += term.c;
  std::erase_if(material.c, [](const auto& entry) { return entry.second == 0; });
  return material;
}

}  // namespace bulbus::inline app
