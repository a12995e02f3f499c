#include "core/problem/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/mesh/geometry.hpp"
#include "core/problem/bars_on_planes.hpp"
#include "core/problem/coincident_nodes.hpp"
#include "core/problem/hanging_nodes.hpp"
#include "core/problem/material_stability.hpp"
#include "core/problem/nodal_forces.hpp"
#include "core/problem/pressed_surfaces.hpp"
#include "core/problem/probes/cancelled_figures.hpp"
#include "core/problem/region_material.hpp"

namespace bulbus::inline problem {
namespace {

using Warnings = std::vector<std::string>;

// An eye measures some 24 mm: in metres it would be below the lower bound, in micrometres above the upper.
constexpr double smallest_size = .1, largest_size = 1000;  // mm

void warn_of_size(const Mesh& mesh, Warnings& warnings) {
  const double size = diagonal(mesh);
  if (size >= smallest_size && size <= largest_size) return;
  warnings.push_back(
      fmt::format("the mesh measures only {:.3g} mm from corner to corner: are its coordinates in metres? "
                  "Then give `scale: 1000` under `mesh`.",
                  size));
  if (size > largest_size)
    warnings.back() = fmt::format(
        "the mesh measures {:.3g} mm from corner to corner: are its coordinates in micrometres? Then give "
        "`scale: 0.001` under `mesh`.",
        size);
}

// Bone has some 5 GPa, soft tissue less than a thousandth of that; a number in Pa or kPa is far above.
constexpr double largest_modulus = 1e4;  // MPa

void warn_of_stiffness(const Model& model, Warnings& warnings) {
  for (const auto& [name, spec] : model.regions) {
    const double mu = spec.rigid ? 0 : initial_shear_modulus(material_of(spec));
    if (mu > largest_modulus)
      warnings.push_back(fmt::format(
          "region '{}' has the shear modulus {:.3g} MPa, as metals have: constants without a unit "
          "are MPa. Write `kPa` or `Pa` behind them if that is meant, or `rigid: true`",
          name, mu));
  }
}

}  // namespace

std::vector<std::string> warnings_of(const Mesh& mesh, const Model& model) {
  Warnings warnings;
  warn_of_size(mesh, warnings);
  warn_of_stiffness(model, warnings);
  for (const Warnings& more :
       {coincident_nodes(mesh, model), hanging_nodes(mesh, model), overlapping_pressures(mesh, model),
        cancelled_figures(model), unstable_regions(model), forces_on_planes(mesh, model),
        bars_on_planes(mesh, model)})
    warnings.insert(warnings.end(), more.begin(), more.end());
  return warnings;
}

}  // namespace bulbus::inline problem
