#include "core/problem/reference_model.hpp"

#include <fmt/format.h>

#include "core/base/did_you_mean.hpp"

namespace bulbus::inline problem {
namespace {

bool counts_from_reference(const DisplaceSpec& d) {
  return d.affine || (d.from == "reference" && (d.x || d.y || d.z || d.radial || d.by));
}

// In the first step reference and start are both the unloaded positions.
void refuse_ambiguous(const Model& model) {
  for (std::size_t k = 1; k < model.steps.size(); ++k)
    for (std::size_t i = 0; i < model.steps[k].displace.size(); ++i)
      if (counts_from_reference(model.steps[k].displace[i]))
        throw scene_error(
            fmt::format("steps.{}.displace.{}", k, i),
            "the displacement counts from the reference: with `reference` these are the unloaded "
            "positions, not the drawn ones",
            "Say `from: start` (or move the set by `translate` and `rotate`), so that it counts "
            "from where the set is when the step begins.");
}

void refuse_no_load(const ReferenceSpec& r) {
  if (r.loaded.empty() && r.loads.empty() && r.displace.empty())
    throw scene_error("reference", "the mesh is drawn under no load",
                      "Give `loaded`, such as {vitreous: 15 mmHg}, or `loads`; or leave `reference` out.");
}

void refuse_unknown_liquids(const Model& model, const ReferenceSpec& r) {
  std::vector<std::string> names;
  for (const auto& [name, liquid] : model.liquids) names.push_back(name);
  for (const auto& [name, pressure] : r.loaded)
    if (!model.liquids.contains(name))
      throw scene_error("reference.loaded." + name, "there is no liquid '" + name + "'",
                        did_you_mean(name, names, "Name one under `liquids`."));
}

}  // namespace

Model reference_model(const Model& model, const ReferenceSpec& reference) {
  refuse_no_load(reference);
  refuse_unknown_liquids(model, reference);
  refuse_ambiguous(model);
  Model m = model;
  m.rigid_bodies.clear();
  m.contacts.clear();
  m.sutures.clear();
  m.probes.clear();
  StepSpec step;
  step.name = "reference";
  step.pressures = reference.loaded;
  step.loads = reference.loads;
  step.displace = reference.displace;
  m.steps = {step};
  return m;
}

InputError in_reference(const InputError& fault) {
  for (const auto& [of_step, of_scene] : {std::pair{"steps.0.pressures", "reference.loaded"},
                                          {"steps.0.loads", "reference.loads"},
                                          {"steps.0.displace", "reference.displace"},
                                          {"steps.0", "reference"}})
    if (fault.key.starts_with(of_step))
      return InputError(fault.what(), of_scene + fault.key.substr(std::string(of_step).size()));
  return fault;
}

}  // namespace bulbus::inline problem
