#include "core/problem/validate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/did_you_mean.hpp"
#include "core/base/error.hpp"
#include "core/mesh/generate/embed.hpp"
#include "core/mesh/geometry.hpp"
#include "core/problem/closed_surface.hpp"
#include "core/problem/fibre_directions.hpp"
#include "core/problem/idle_keys.hpp"
#include "core/problem/plausible.hpp"
#include "core/problem/pressed_surfaces.hpp"
#include "core/problem/probes/cancelled_figures.hpp"
#include "core/problem/region_material.hpp"
#include "core/problem/symmetry_planes.hpp"

namespace bulbus::inline problem {
namespace {

template <class Map>
std::vector<std::string> names_of(const Map& map) {
  std::vector<std::string> names;
  for (const auto& [name, value] : map) names.push_back(name);
  return names;
}

std::string known(const std::string& word, const std::vector<std::string>& names) {
  std::string list;
  for (const auto& n : names) list += (list.empty() ? "" : ", ") + n;
  return did_you_mean(word, names, names.empty() ? "The mesh has none." : "Known: " + list + ".");
}

// On every rank alike, before each asks for those of its own hexahedra.
void check_fibres(const Mesh& mesh, const std::string& region, const FibresSpec& fibres) {
  std::vector<double> X;
  std::vector<Hex> hexes;
  for (const Point& p : mesh.points) X.insert(X.end(), p.begin(), p.end());
  for (std::size_t h = 0; h < mesh.hexes.size(); ++h)
    if (mesh.region[h] == region_index(mesh, region)) hexes.push_back(mesh.hexes[h]);
  fibre_directions(fibres, "regions." + region + ".fibres", X, hexes);
}

void check_regions(const Mesh& mesh, const Model& model) {
  for (const auto& [name, spec] : model.regions)
    if (region_index(mesh, name) < 0)
      throw scene_error("regions." + name, "material for a region '" + name + "' that the mesh does not have",
                        known(name, mesh.region_names));
  for (const std::string& name : mesh.region_names)
    if (!model.regions.contains(name))
      throw scene_error("regions", "region '" + name + "' of the mesh has no material",
                        "Add `" + name + ": {c10: ...}` under `regions`.");
  for (const auto& [name, spec] : model.regions) {
    check_law(spec, "regions." + name);
    if (spec.rigid) continue;
    const double mu = initial_shear_modulus(material_of(spec));
    if (!(mu > 0) || !std::isfinite(mu))
      throw scene_error(
          "regions." + name,
          fmt::format("region '{}' has the initial shear modulus 2 (c10 + c01) = {:g} MPa", name, mu),
          "It must be positive and finite: give c10 (and c01), or `rigid: true`.");
    if (spec.fibres) check_fibres(mesh, name, *spec.fibres);
  }
}

void check_set(const Mesh& mesh, const std::string& set, const std::string& key) {
  try {
    if (!nodes_of(mesh, set).empty()) return;
  } catch (const InputError& e) {
    throw InputError(e.what(), key);
  }
  throw scene_error(key, "set '" + set + "' is empty",
                    "Put at least one node into it, or leave the entry out.");
}

// A rigid region's nodes follow its six unknowns: a constraint of single ones would be lost.
void check_not_rigid(const Mesh& mesh, const Model& model, const std::string& set, const std::string& key) {
  for (const auto& [name, spec] : model.regions) {
    if (!spec.rigid) continue;
    const auto fixed = nodes_of(mesh, set), rigid = nodes_of_region(mesh, region_index(mesh, name));
    if (std::ranges::any_of(fixed, [&](int n) { return std::ranges::binary_search(rigid, n); }))
      throw scene_error(key,
                        "set '" + set + "' has nodes of the rigid region '" + name +
                            "', which cannot be constrained one by one",
                        "Take them out of the set, or let the region deform.");
  }
}

void check_surface(const Mesh& mesh, const std::string& surface, const std::string& key) {
  const auto found = mesh.surfaces.find(surface);
  if (found == mesh.surfaces.end())
    throw scene_error(key, "the mesh has no surface '" + surface + "'",
                      known(surface, names_of(mesh.surfaces)));
  if (found->second.empty())
    throw scene_error(key, "surface '" + surface + "' is empty", "Put at least one face into it.");
}

// What a displacement prescribes of its set.
std::vector<std::string> prescribed(const DisplaceSpec& d) {
  if (d.affine || d.rotate || d.translate) return {"x", "y", "z"};
  std::vector<std::string> all;
  for (const auto& [name, given] :
       {std::pair{"x", &d.x}, {"y", &d.y}, {"z", &d.z}, {"radial", &d.radial}, {"by", &d.by}})
    if (*given) all.emplace_back(name);
  return all;
}

// What one step says twice of the same set replaces what it said first.
void refuse_twice(const StepSpec& step, const std::string& key) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < step.displace.size(); ++i)
    for (const std::string& what : prescribed(step.displace[i])) {
      const std::string& set = step.displace[i].set;
      if (!seen.insert(what + " " + set).second)
        throw scene_error(key + ".displace." + std::to_string(i),
                          "displacement " + what + " of '" + set +
                              "' is given twice in one step: only the last would count",
                          "Keep one of the two, or give their sum.");
    }
}

void check_step(const Mesh& mesh, const Model& model, const StepSpec& step, const std::string& key) {
  refuse_twice(step, key);
  for (std::size_t i = 0; i < step.displace.size(); ++i) {
    const DisplaceSpec& d = step.displace[i];
    const std::string at = key + ".displace." + std::to_string(i);
    check_set(mesh, d.set, at + ".set");
    check_not_rigid(mesh, model, d.set, at + ".set");
    if (d.affine && d.affine->size() != 9)
      throw scene_error(at + ".affine", fmt::format("`affine` has {} numbers", d.affine->size()),
                        "Give nine: the rows of F.");
    if (d.affine && (d.rotate || d.translate))
      throw scene_error(at + ".affine", "`affine` and a rigid motion are given together",
                        "Keep one of them.");
    if (d.by && norm(d.along) == 0)
      throw scene_error(at + ".by", "`by` has no direction", "Give `along: [.., .., ..]`.");
    if (!d.x && !d.y && !d.z && !d.radial && !d.by && !d.affine && !d.rotate && !d.translate)
      throw scene_error(at, "nothing is prescribed on '" + d.set + "'",
                        "Give x, y, z, radial, by, affine, rotate or translate.");
    if ((d.rotate && norm(d.rotate->axis) == 0) || (d.radial && norm(d.axis) == 0))
      throw scene_error(at, "the axis has no direction", "Give `axis` a length.");
    refuse_idle_keys(d, at);
  }
  for (std::size_t i = 0; i < step.loads.size(); ++i) {
    const LoadSpec& l = step.loads[i];
    const std::string at = key + ".loads." + std::to_string(i);
    if (l.pressure) check_surface(mesh, l.surface, at + ".surface");
    if (l.force) check_set(mesh, l.set, at + ".set");
    if (!l.pressure && !l.force)
      throw scene_error(at, "a load without size", "Give `surface` and `pressure`, or `set` and `force`.");
    refuse_idle_keys(l, at);
  }
  for (std::size_t i = 0; i < step.move.size(); ++i) {
    const MoveSpec& m = step.move[i];
    const auto body = model.rigid_bodies.find(m.body);
    if (m.shorten != 0 && body != model.rigid_bodies.end() &&
        ((!body->second.band && !body->second.tire && !body->second.swept) ||
         norm(body->second.direction) > 0))
      throw scene_error(key + ".move." + std::to_string(i) + ".shorten",
                        "'" + m.body +
                            "' has no circumference to shorten: it is no band, tire or swept section, or "
                            "has a `direction` of its own",
                        "Give `translate`, or `close` for a motion along its own direction.");
  }
}

bool is_one_of(const std::string& kind, std::initializer_list<const char*> kinds) {
  return std::ranges::find(kinds, kind) != kinds.end();
}

void check_probe(const Mesh& mesh, const Model& model, const ProbeSpec& p, const std::string& key) {
  const bool needs_liquid = is_one_of(p.kind, {"pressure", "volume"});
  const bool needs_to = is_one_of(p.kind, {"distance", "buckle_height", "refraction"});
  const bool needs_set =
      needs_to || is_one_of(p.kind, {"displacement", "position", "reaction", "moment", "sealed_fraction",
                                     "corneal_power", "corneal_astigmatism", "steep_meridian"});
  const bool of_cells = is_one_of(p.kind, {"mises", "suture_mises", "volume_ratio"});
  if (needs_liquid && !model.liquids.contains(p.liquid))
    throw scene_error(key + ".liquid", "there is no liquid '" + p.liquid + "'",
                      known(p.liquid, names_of(model.liquids)));
  if (p.of != "whole" && !sums_forces(p.kind))
    throw scene_error(key + ".of", "`of` says nothing for a probe of the kind '" + p.kind + "'",
                      "Leave it out: it is for sums of forces and moments.");
  if (needs_set || !p.set.empty()) check_set(mesh, p.set, key + ".set");
  if (needs_to) check_set(mesh, p.to, key + ".to");
  if (((of_cells && !p.region.empty()) || p.kind == "refraction") && region_index(mesh, p.region) < 0)
    throw scene_error(key + ".region", "the mesh has no region '" + p.region + "'",
                      known(p.region, mesh.region_names));
  if (!p.region.empty() && p.kind == "bar_force" && !model.bars.contains(p.region))
    throw scene_error(key + ".region", "there are no bars '" + p.region + "'",
                      known(p.region, names_of(model.bars)));
  std::vector<std::string> steps;
  for (const StepSpec& s : model.steps)
    if (!s.name.empty()) steps.push_back(s.name);
  if (!p.since.empty() && std::ranges::count(steps, p.since) == 0)
    throw scene_error(key + ".since", "there is no step '" + p.since + "'", known(p.since, steps));
}

void check_bars(const Mesh& mesh, const Model& model) {
  for (const auto& [name, spec] : model.bars)
    if (!mesh.bars.contains(name))
      throw scene_error("bars." + name, "the mesh has no bars '" + name + "'",
                        known(name, names_of(mesh.bars)));
  for (const auto& [name, group] : mesh.bars) {
    if (!group.empty() && !model.bars.contains(name))
      throw scene_error("bars", "bars '" + name + "' of the mesh have no stiffness",
                        "Add `" + name + ": {E: ..., area: ...}` under `bars`.");
    for (std::size_t i = 0; i < group.size(); ++i) {
      const Point a = position(mesh, group[i].a), b = position(mesh, group[i].b);
      if (norm(b - a) > mesh_tolerance(mesh)) continue;
      throw scene_error(
          "bars." + name,
          fmt::format("bar {} of '{}' has no length: both of its ends are at ({:.6g}, {:.6g}, "
                      "{:.6g}) mm",
                      i + 1, name, a[0], a[1], a[2]),
          "Take it out of the mesh, or move one end; nodes that are to move as one are one node.");
    }
  }
}

}  // namespace

std::set<std::string> shared_surfaces(const Mesh& mesh, const Model& model) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < model.contacts.size(); ++i) {
    const ContactSpec& c = model.contacts[i];
    const std::string key = "contacts." + std::to_string(i);
    check_surface(mesh, c.slave, key + ".slave");
    names.insert(c.slave);
    if (c.slave == c.master)
      throw scene_error(
          key + ".master", "contact '" + c.name + "' names surface '" + c.slave + "' twice",
          "Give the two sides as two surfaces: nodes that touch their own surface are not looked for.");
    if (c.two_way && model.rigid_bodies.contains(c.master))
      throw scene_error(
          key + ".two_way",
          "contact '" + c.name + "' goes both ways, and its master '" + c.master +
              "' is a rigid body, which has no nodes",
          "Leave `two_way` out; `divisions: 4` lets the slave's faces feel edges finer than the mesh.");
    if (c.two_way && c.tolerance > 0)
      throw scene_error(
          key + ".two_way",
          "contact '" + c.name +
              "' goes both ways and has a `tolerance`: two multipliers for one pressure have no limit",
          "Leave `tolerance` out and give a larger `penalty`, or leave `two_way` out.");
    if (model.rigid_bodies.contains(c.master)) {
      if (mesh.surfaces.contains(c.master))
        throw scene_error(key + ".master",
                          "'" + c.master + "' is both a surface of the mesh and a rigid body",
                          "Rename the rigid body.");
      continue;
    }
    if (!mesh.surfaces.contains(c.master)) {
      auto known_masters = names_of(mesh.surfaces);
      for (const auto& [name, body] : model.rigid_bodies) known_masters.push_back(name);
      throw scene_error(key + ".master", "there is no surface or rigid body '" + c.master + "'",
                        known(c.master, known_masters));
    }
    check_surface(mesh, c.master, key + ".master");
    names.insert(c.master);
  }
  for (const auto& [name, suture] : model.sutures)
    if (mesh.surfaces.contains(suture.surface)) names.insert(suture.surface);
  return names;
}

void validate(const Mesh& mesh, const Model& model) {
  check_regions(mesh, model);
  check_bars(mesh, model);
  for (const auto& [name, spec] : model.liquids)
    check_surface(mesh, spec.surface, "liquids." + name + ".surface");
  require_at_planes(mesh, model);
  for (const auto& [name, spec] : model.liquids)
    require_closed(mesh, mesh.surfaces.at(spec.surface), model.symmetry, spec.surface,
                   "liquids." + name + ".surface");
  for (std::size_t i = 0; i < model.fix.size(); ++i) {
    check_set(mesh, model.fix[i].set, "fix." + std::to_string(i) + ".set");
    check_not_rigid(mesh, model, model.fix[i].set, "fix." + std::to_string(i) + ".set");
    if (model.fix[i].directions.empty())
      throw scene_error("fix." + std::to_string(i) + ".directions", "no direction of the set is fixed",
                        "Give some of x, y and z, or leave `directions` out for all three.");
  }
  for (const auto& [name, suture] : model.sutures)
    for (const std::string& set : suture.sets) check_set(mesh, set, "sutures." + name + ".sets");
  if (model.steps.empty()) throw scene_error("steps", "there are no steps", "Give at least one.");
  for (std::size_t i = 0; i < model.steps.size(); ++i)
    check_step(mesh, model, model.steps[i], "steps." + std::to_string(i));
  for (std::size_t i = 0; i < model.probes.size(); ++i)
    check_probe(mesh, model, model.probes[i], "probes." + std::to_string(i));
  require_clear_pressures(mesh, model);
  require_plausible_sizes(mesh, model);
  require_supported(mesh, model);
}

}  // namespace bulbus::inline problem
