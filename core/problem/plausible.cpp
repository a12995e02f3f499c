#include "core/problem/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/mesh/geometry.hpp"
#include "core/problem/formula.hpp"
#include "core/problem/validate.hpp"

namespace bulbus {
namespace {

constexpr double most_moduli = 10, most_diagonals = 5;

struct Sizes {
  double modulus = 0, diagonal = 0;  // MPa, mm
};

Sizes sizes_of(const Mesh& mesh, const Model& model) {
  Sizes sizes{.diagonal = diagonal(mesh)};
  for (const auto& [name, spec] : model.regions)
    if (!spec.rigid) sizes.modulus = std::max(sizes.modulus, initial_shear_modulus(make_material(terms_of(spec))));
  return sizes;
}

// The unit with which the number would be of an ordinary size.
std::string likelier(double value, double largest, std::initializer_list<const char*> units, Quantity quantity) {
  for (const char* unit : units)
    if (std::abs(value) * parse_quantity(std::string("1 ") + unit, quantity) <= largest) return unit;
  return *(units.end() - 1);
}

void check_pressure(const Sizes& sizes, const std::string& text, const std::string& key) {
  const Formula formula(text, key);
  if (!formula.bare() || sizes.modulus == 0) return;
  const double p = formula({0, 0, 0}, 1, 1);
  if (std::abs(p) <= most_moduli * sizes.modulus) return;
  throw scene_error(key,
                    fmt::format("{0} MPa is {1:.3g} times the shear modulus of the stiffest region, {2:.3g} MPa: did you mean `{0} {3}`?", text,
                                std::abs(p) / sizes.modulus, sizes.modulus, likelier(p, sizes.modulus, {"mmHg", "Pa"}, Quantity::stress)),
                    fmt::format("Write the unit behind the number: `{0} mmHg`, `{0} kPa`, or `{0} MPa` if that is meant.", text));
}

void check_displacement(const Sizes& sizes, const std::optional<std::string>& text, const std::string& key) {
  if (!text) return;
  const Formula formula(*text, key);
  if (!formula.bare()) return;
  const double u = formula({0, 0, 0}, 1, 1);
  if (std::abs(u) <= most_diagonals * sizes.diagonal) return;
  throw scene_error(key, fmt::format("{0} mm is {1:.3g} times the diagonal of the mesh, {2:.3g} mm: did you mean `{0} um`?", *text,
                                     std::abs(u) / sizes.diagonal, sizes.diagonal),
                    fmt::format("Write the unit behind the number: `{0} um`, or `{0} mm` if that is meant.", *text));
}

}  // namespace

void require_plausible_sizes(const Mesh& mesh, const Model& model) {
  const Sizes sizes = sizes_of(mesh, model);
  for (std::size_t k = 0; k < model.steps.size(); ++k) {
    const StepSpec& step = model.steps[k];
    const std::string at = "steps." + std::to_string(k) + ".";
    for (const auto& [name, text] : step.pressures) check_pressure(sizes, text, at + "pressures." + name);
    for (std::size_t i = 0; i < step.loads.size(); ++i)
      if (step.loads[i].pressure) check_pressure(sizes, *step.loads[i].pressure, at + fmt::format("loads.{}.pressure", i));
    for (std::size_t i = 0; i < step.displace.size(); ++i) {
      const DisplaceSpec& d = step.displace[i];
      const std::string key = at + fmt::format("displace.{}.", i);
      for (const auto& [name, text] : {std::pair{"x", &d.x}, {"y", &d.y}, {"z", &d.z}, {"radial", &d.radial}, {"by", &d.by}})
        check_displacement(sizes, *text, key + name);
    }
  }
}

}  // namespace bulbus
