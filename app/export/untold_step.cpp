#include "app/export/untold_step.hpp"

#include <map>
#include <set>

#include "core/mesh/faces.hpp"

namespace bulbus::inline app {
namespace {

std::string untold_displacement(const DisplaceSpec& spec, int step) {
  const std::string set = "set '" + spec.set + "'";
  if (spec.radial || spec.by) return set + " has a displacement along a direction of its own";
  if (spec.from == "start" && step > 0) return "the displacement of " + set + " counts from the step's start";
  if ((spec.rotate || spec.translate) && step > 0)
    return "the motion of " + set + " counts from the step's start";
  return "";
}

// Surfaces that have carried a pressure up to the end of a step.
std::set<std::string> surfaces_under_pressure(const Model& model, int step) {
  std::set<std::string> surfaces;
  for (int k = 0; k <= step; ++k) {
    for (const LoadSpec& load : model.steps[k].loads)
      if (load.pressure && !load.dead) surfaces.insert(load.surface);
    for (const auto& [name, pressure] : model.steps[k].pressures)
      surfaces.insert(model.liquids.at(name).surface);
  }
  return surfaces;
}

// Programs take a second pressure of a face in place of the first one.
std::string pressed_twice(const Model& model, const Mesh& mesh, int step) {
  const auto surfaces = surfaces_under_pressure(model, step);
  if (surfaces.size() < 2) return "";
  const FaceTable table(mesh.hexes);
  std::map<int, std::string> owner;
  for (const std::string& surface : surfaces)
    for (const Quad& q : mesh.surfaces.at(surface))
      if (const auto [at, fresh] = owner.try_emplace(table.first(q), surface);
          !fresh && at->second != surface)
        return "the surfaces '" + at->second + "' and '" + surface +
               "' share a face, and each has a pressure";
  return "";
}

}  // namespace

std::string untold(const Model& model, const Mesh& mesh, int step) {
  const StepSpec& spec = model.steps[step];
  if (!spec.enclose.empty()) return "liquid '" + spec.enclose[0] + "' is enclosed as a fluid cavity";
  if (!spec.add.empty()) return "the volume of liquid '" + spec.add.begin()->first + "' is prescribed";
  if (!spec.move.empty()) return "rigid body '" + spec.move[0].body + "' moves";
  if (!spec.sew.empty()) return "suture '" + spec.sew.begin()->first + "' pulls";
  if (!spec.release.empty()) return "'" + spec.release[0] + "' is released";
  for (const DisplaceSpec& displace : spec.displace)
    if (const std::string reason = untold_displacement(displace, step); !reason.empty()) return reason;
  for (const LoadSpec& load : spec.loads)
    if (load.pressure && !load.region.empty())
      return "the pressure on '" + load.surface + "' acts on one of two regions";
  return pressed_twice(model, mesh, step);
}

}  // namespace bulbus::inline app
