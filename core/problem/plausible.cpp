#include "core/problem/plausible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/mesh/geometry.hpp"
#include "core/problem/formula.hpp"
#include "core/problem/region_material.hpp"

namespace bulbus::inline problem {
namespace {

constexpr double most_moduli = 10, most_diagonals = 5;

struct Sizes {
  double modulus = 0, diagonal = 0;  // MPa, mm
};

Sizes sizes_of(const Mesh& mesh, const Model& model) {
  Sizes sizes{.diagonal = diagonal(mesh)};
  for (const auto& [name, spec] : model.regions)
    if (!spec.rigid) sizes.modulus = std::max(sizes.modulus, initial_shear_modulus(material_of(spec)));
  return sizes;
}

// The unit with which the number would be of an ordinary size.
std::string likelier(double value, double largest, std::initializer_list<const char*> units,
                     Quantity quantity) {
  for (const char* unit : units)
    if (std::abs(value) * parse_quantity(std::string("1 ") + unit, quantity) <= largest) return unit;
  return *(units.end() - 1);
}

void check_pressure(const Sizes& sizes, const std::string& text, const std::string& key) {
  const Formula formula(text, key);
  if (!formula.bare() || sizes.modulus == 0) return;
  const double p = formula({0, 0, 0}, 1, 1);
  if (std::abs(p) <= most_moduli * sizes.modulus) return;
  throw scene_error(
      key,
      fmt::format("{0} MPa is {1:.3g} times the shear modulus of the stiffest region, {2:.3g} MPa: did you "
                  "mean `{0} {3}`?",
                  text, std::abs(p) / sizes.modulus, sizes.modulus,
                  likelier(p, sizes.modulus, {"mmHg", "Pa"}, Quantity::stress)),
      fmt::format("Write the unit behind the number: `{0} mmHg`, `{0} kPa`, or `{0} MPa` if that is meant.",
                  text));
}

void check_displacement(const Sizes& sizes, const std::optional<std::string>& text, const std::string& key) {
  if (!text) return;
  const Formula formula(*text, key);
  if (!formula.bare()) return;
  const double u = formula({0, 0, 0}, 1, 1);
  if (std::abs(u) <= most_diagonals * sizes.diagonal) return;
  throw scene_error(
      key,
      fmt::format("{0} mm is {1:.3g} times the diagonal of the mesh, {2:.3g} mm: did you mean `{0} um`?",
                  *text, std::abs(u) / sizes.diagonal, sizes.diagonal),
      fmt::format("Write the unit behind the number: `{0} um`, or `{0} mm` if that is meant.", *text));
}

// What no unit explains: such motions lead out of sight, and such forces are beyond what any tissue bears.
constexpr double most_way = 1000, most_force = 1000, most_volume = 100;

void check_size(double value, double most, const std::string& key, const std::string& what,
                const std::string& unit, const std::string& against) {
  if (std::abs(value) <= most) return;
  throw scene_error(key, fmt::format("{} of {:.3g} {} is {}", what, value, unit, against),
                    fmt::format("Give at most {:.2g} {}.", most, unit));
}

void check_step(const Sizes& sizes, const StepSpec& step, const std::string& at) {
  const double way = most_way * sizes.diagonal,
               force = most_force * sizes.modulus * sizes.diagonal * sizes.diagonal;
  for (std::size_t i = 0; i < step.move.size(); ++i) {
    const std::string key = at + fmt::format("move.{}", i),
                      against = "more than a thousand times the mesh's diagonal";
    check_size(norm(step.move[i].translate), way, key + ".translate", "a shift", "mm", against);
    check_size(step.move[i].close, way, key + ".close", "a way", "mm", against);
    check_size(step.move[i].shorten, way, key + ".shorten", "a way", "mm", against);
  }
  for (const auto& [name, volume] : step.add)
    check_size(volume, most_volume * std::pow(sizes.diagonal, 3), at + "add." + name, "a volume", "mm3",
               "more than a hundred times the cube of the mesh's diagonal");
  if (force == 0) return;
  const std::string against =
      "more than a thousand times the stiffest region's shear modulus times the mesh's diagonal squared";
  for (std::size_t i = 0; i < step.loads.size(); ++i)
    if (step.loads[i].force)
      check_size(norm(*step.loads[i].force), force, at + fmt::format("loads.{}.force", i), "a force", "N",
                 against);
  for (const auto& [name, pull] : step.sew)
    check_size(pull, force, at + "sew." + name, "a force", "N", against);
}

void check_specs(const Sizes& sizes, const Model& model) {
  for (const auto& [name, bar] : model.bars)
    check_size(bar.area, sizes.diagonal * sizes.diagonal, "bars." + name + ".area", "a cross-section", "mm2",
               "more than the square of the mesh's diagonal");
  for (const auto& [name, suture] : model.sutures)
    if (suture.sets.empty())
      check_size(suture.bite, .25 * sizes.diagonal * sizes.diagonal, "sutures." + name + ".bite", "a bite",
                 "mm2", "more than a quarter of the square of the mesh's diagonal: all of the surface");
  for (std::size_t i = 0; i < model.contacts.size(); ++i)
    check_size(model.contacts[i].tolerance, sizes.diagonal, fmt::format("contacts.{}.tolerance", i),
               "a penetration", "mm", "more than the mesh's diagonal");
}

}  // namespace

void require_plausible_sizes(const Mesh& mesh, const Model& model) {
  const Sizes sizes = sizes_of(mesh, model);
  check_specs(sizes, model);
  for (std::size_t k = 0; k < model.steps.size(); ++k) {
    const StepSpec& step = model.steps[k];
    const std::string at = "steps." + std::to_string(k) + ".";
    check_step(sizes, step, at);
    for (const auto& [name, text] : step.pressures) check_pressure(sizes, text, at + "pressures." + name);
    for (std::size_t i = 0; i < step.loads.size(); ++i)
      if (step.loads[i].pressure)
        check_pressure(sizes, *step.loads[i].pressure, at + fmt::format("loads.{}.pressure", i));
    for (std::size_t i = 0; i < step.displace.size(); ++i) {
      const DisplaceSpec& d = step.displace[i];
      const std::string key = at + fmt::format("displace.{}.", i);
      for (const auto& [name, text] :
           {std::pair{"x", &d.x}, {"y", &d.y}, {"z", &d.z}, {"radial", &d.radial}, {"by", &d.by}})
        check_displacement(sizes, *text, key + name);
    }
  }
}

}  // namespace bulbus::inline problem
