#include "core/problem/pressed_surfaces.hpp"

#include <fmt/format.h>

#include <set>

#include "core/base/did_you_mean.hpp"
#include "core/base/error.hpp"
#include "core/base/tensor.hpp"
#include "core/problem/surface_sides.hpp"

namespace bulbus::inline problem {
namespace {

// Whether the sign of the load depends on the side that a face is seen from.
bool has_a_side(const LoadSpec& load) { return load.pressure && !(load.dead && norm(load.direction) > 0); }

std::set<std::string> one_sided_surfaces(const Mesh& mesh, const Model& model) {
  std::set<std::string> names;
  for (const auto& [name, liquid] : model.liquids) names.insert(liquid.surface);
  for (const ContactSpec& c : model.contacts)
    for (const std::string& side : {c.slave, c.master})
      if (mesh.surfaces.contains(side)) names.insert(side);
  for (const StepSpec& step : model.steps)
    for (const LoadSpec& load : step.loads)
      if (has_a_side(load)) names.insert(load.surface);
  return names;
}

void require_boundary(const Mesh& mesh, const SurfaceSides& sides, const std::string& surface,
                      const std::string& what, const std::string& key) {
  for (const Quad& q : mesh.surfaces.at(surface))
    if (const auto& [a, b] = sides.of(q); b >= 0)
      throw scene_error(
          key,
          fmt::format("surface '{}' has faces with hexahedra on both sides (regions '{}' and '{}'): {}",
                      surface, mesh.region_names[a], mesh.region_names[b], what),
          "Take these faces out of the surface, or mesh the two sides with nodes of their own.");
}

void require_region(const Mesh& mesh, const SurfaceSides& sides, const LoadSpec& load,
                    const std::string& key) {
  const int region = load.region.empty() ? -1 : region_index(mesh, load.region);
  if (!load.region.empty() && region < 0)
    throw scene_error(key + ".region", "the mesh has no region '" + load.region + "'",
                      did_you_mean(load.region, mesh.region_names, "Name one of its regions."));
  const auto& faces = mesh.surfaces.at(load.surface);
  const auto has_one_side = [&](const Quad& q, int r) {
    return (sides.of(q)[0] == r) != (sides.of(q)[1] == r);
  };
  const auto has_all = [&](int r) {
    return r >= 0 && std::ranges::all_of(faces, [&](const Quad& q) { return has_one_side(q, r); });
  };
  const auto named = [&](const std::string& one_of, int a, int b) -> std::string {
    return has_all(a) || has_all(b) ? one_of
                                    : "Divide the surface, and give each part its pressure: no "
                                      "region has a hexahedron at all of its faces.";
  };
  for (const Quad& q : faces) {
    const auto& [a, b] = sides.of(q);
    const std::string first = mesh.region_names[a], second = b < 0 ? "" : mesh.region_names[b];
    if (region < 0 ? b < 0 : has_one_side(q, region)) continue;
    if (a == b)
      throw scene_error(
          key + ".surface",
          fmt::format("surface '{}' has faces amid region '{}': nothing says on which side the pressure acts",
                      load.surface, first),
          "Mesh the two sides as two regions, or with nodes of their own.");
    if (region < 0)
      throw scene_error(key + ".surface",
                        fmt::format("surface '{}' has faces between the regions '{}' and '{}': nothing says "
                                    "on which of them the pressure acts",
                                    load.surface, first, second),
                        named(fmt::format("Name it: `region: {}` or `region: {}`.", first, second), a, b));
    throw scene_error(
        key + ".region",
        fmt::format("surface '{}' has faces without a hexahedron of region '{}'", load.surface, load.region),
        named("Name the region that the pressure acts on: '" + first +
                  (b < 0 ? "'." : "' or '" + second + "'."),
              a, b));
  }
}

void require_apart(const Mesh& mesh, const Model& model) {
  for (auto a = model.liquids.begin(); a != model.liquids.end(); ++a)
    for (auto b = std::next(a); b != model.liquids.end(); ++b)
      if (const int common = common_faces(mesh, a->second.surface, b->second.surface); common > 0)
        throw scene_error("liquids." + b->first + ".surface",
                          fmt::format("the liquids '{}' and '{}' share {} faces (surfaces '{}' and '{}'): "
                                      "their pressures would add up there",
                                      a->first, b->first, common, a->second.surface, b->second.surface),
                          "Give every liquid a surface of its own, or describe one liquid.");
}

void require_once(const StepSpec& step, const std::string& key) {
  std::set<std::string> pressed, pulled;
  for (std::size_t i = 0; i < step.loads.size(); ++i) {
    const LoadSpec& l = step.loads[i];
    const std::string at = fmt::format("{}.loads.{}", key, i);
    if (l.pressure && !pressed.insert(l.surface).second)
      throw scene_error(
          at + ".surface",
          "surface '" + l.surface + "' gets two pressures in one step: the second would replace the first",
          "Give their sum as one pressure.");
    if (l.force && !pulled.insert(l.set).second)
      throw scene_error(at + ".set",
                        "set '" + l.set + "' gets two forces in one step: the second would replace the first",
                        "Give their sum as one force.");
  }
}

}  // namespace

void require_clear_pressures(const Mesh& mesh, const Model& model) {
  const SurfaceSides sides(mesh, one_sided_surfaces(mesh, model));
  for (const auto& [name, liquid] : model.liquids)
    require_boundary(mesh, sides, liquid.surface, "no liquid can be there", "liquids." + name + ".surface");
  require_apart(mesh, model);
  for (std::size_t i = 0; i < model.contacts.size(); ++i)
    for (const auto& [side, name] :
         {std::pair{"slave", model.contacts[i].slave}, {"master", model.contacts[i].master}})
      if (mesh.surfaces.contains(name))
        require_boundary(mesh, sides, name, "nothing can touch them", fmt::format("contacts.{}.{}", i, side));
  for (std::size_t k = 0; k < model.steps.size(); ++k) {
    const auto& loads = model.steps[k].loads;
    for (std::size_t i = 0; i < loads.size(); ++i)
      if (has_a_side(loads[i])) require_region(mesh, sides, loads[i], fmt::format("steps.{}.loads.{}", k, i));
    require_once(model.steps[k], fmt::format("steps.{}", k));
  }
}

std::vector<std::string> overlapping_pressures(const Mesh& mesh, const Model& model) {
  std::set<std::string> loaded, wet;
  for (const auto& [name, liquid] : model.liquids) wet.insert(liquid.surface);
  for (const StepSpec& step : model.steps)
    for (const LoadSpec& load : step.loads)
      if (load.pressure) loaded.insert(load.surface);
  std::vector<std::string> warnings;
  const auto compare = [&](const std::string& a, const std::string& b, const char* what) {
    if (const int common = common_faces(mesh, a, b); common > 0)
      warnings.push_back(
          fmt::format("surface '{}', which has a pressure, and surface '{}'{} share {} faces: there the "
                      "pressures add up.",
                      a, b, what, common));
  };
  for (auto a = loaded.begin(); a != loaded.end(); ++a) {
    for (auto b = std::next(a); b != loaded.end(); ++b) compare(*a, *b, ", which has another,");
    for (const std::string& b : wet) compare(*a, b, " of a liquid");
  }
  return warnings;
}

}  // namespace bulbus::inline problem
