#include "app/prepare.hpp"

#include "app/eye/tissues.hpp"
#include "app/records/alike_names.hpp"
#include "app/records/probe_kinds.hpp"
#include "app/records/record_names.hpp"
#include "app/scene/contact_limits.hpp"
#include "app/scene/size_limits.hpp"
#include "contact/coarse_slaves.hpp"
#include "core/base/error.hpp"
#include "core/mesh/overlapping.hpp"
#include "core/problem/nodal_forces.hpp"
#include "core/problem/reference_model.hpp"
#include "core/problem/symmetry_planes.hpp"
#include "core/problem/thickened_sets.hpp"
#include "core/problem/validate.hpp"
#include "core/problem/warnings.hpp"
#include "core/solve/direct/make_factorisation.hpp"

namespace bulbus::inline app {
namespace {

MeshHierarchy meshes_of(const Scene& scene, const Comm& comm, ToldOfMesh& told) {
  MeshHierarchy meshes;
  try {
    comm.together([&] {
      refuse_too_many_facets(scene, comm.size());
      if (const auto base = count_of(scene.mesh)) refuse_too_large(*base, scene, comm.size());
      meshes = make_meshes(scene.mesh, &told, [&](Mesh& base) { move_onto_planes(base, scene.model); });
      if (scene.mesh.file) refuse_too_large(count(meshes.base), scene, comm.size());
      refuse_too_many_points(meshes.base, scene, comm.size());
      refuse_unsound(meshes.base, scene);
    });
  } catch (const InputError& fault) {
    throw InputError(fault.what(), fault.key.empty() ? "mesh" : fault.key);
  }
  return meshes;
}

std::vector<MeshLevel> levels_of(const MeshHierarchy& meshes, const Model& model, const Comm& comm) {
  auto levels = distribute_levels(meshes.base, meshes.refinements, comm, shared_surfaces(meshes.base, model));
  if (meshes.refinements == 0) return levels;  // the base has been found right
  try {
    refuse_inverted(*levels.back().mesh);
  } catch (const InputError& fault) {
    throw InputError(fault.what(), "mesh");
  }
  return levels;
}

void keep_finest(std::vector<MeshLevel>& levels) {
  levels.erase(levels.begin(), levels.end() - 1);
  levels.back().prolongation.reset();
}

// What the search for the unloaded reference would stumble over.
void check_reference(const ReferenceSpec& reference, const Mesh& base, const Model& model,
                     std::vector<MeshLevel>& levels) {
  const Model loaded = reference_model(model, reference);
  try {
    validate(base, loaded);
    Problem problem(std::move(levels), loaded);
    problem.rehearse(1);
    levels = std::move(problem).take_levels();
  } catch (const InputError& fault) {
    throw in_reference(fault);
  }
}

void rehearse(Problem& problem, const Mesh& base) {
  const auto interactions = Interactions::attach(problem, base);
  const ProbeSet probes(problem, probe_kinds(interactions));
  problem.rehearse(static_cast<int>(problem.model().steps.size()));
}

}  // namespace

void refuse_unsound(const Mesh& base, const Scene& scene) {
  refuse_inverted(base);
  if (scene.mesh.file) refuse_overlapping(base);
}

Prepared prepare(const Scene& scene, const Comm& comm) {
  scene.validate();
  refuse_outside(scene);
  check_direct(scene.solver.linear, comm.size());
  auto inputs = input_files(scene, comm);
  ToldOfMesh told;
  const MeshHierarchy meshes = meshes_of(scene, comm, told);
  Model model = scene.model;
  add_tissues(scene.materials, meshes.base.region_names, model);
  require_tissues(meshes.base.region_names, model);
  validate(meshes.base, model);
  refuse_names_alike_in_records(model);
  if (meshes.refinements > 0) require_forces_kept(meshes.base, model);
  auto levels = levels_of(meshes, model, comm);
  if (!scene.solver.linear.wants_hierarchy()) keep_finest(levels);
  if (scene.reference) check_reference(*scene.reference, meshes.base, model, levels);
  Prepared prepared{std::make_unique<Problem>(std::move(levels), model),
                    nullptr,
                    {},
                    std::move(told.notes),
                    {},
                    std::move(inputs),
                    scene.reference ? std::make_shared<Mesh>(meshes.base) : nullptr};
  prepared.quality = quality(prepared.problem->mesh());
  rehearse(*prepared.problem, meshes.base);
  prepared.warnings = std::move(told.warnings);
  const auto more_nodes =
      meshes.refinements > 0 ? thickened_sets(meshes.base, model) : std::vector<std::string>{};
  std::vector<std::string> by_condition;
  for (const auto& [name, condition] : scene.mesh.surfaces) by_condition.push_back(name);
  for (const auto& more :
       {warnings_of(meshes.base, model), prepared.problem->warnings(), coarse_slaves(meshes.base, model),
        more_nodes, thickened_surfaces(meshes.base, by_condition)})
    prepared.warnings.insert(prepared.warnings.end(), more.begin(), more.end());
  prepared.interactions = Interactions::attach(*prepared.problem, meshes.base);
  for (const auto& [name, body] : prepared.interactions->bodies())
    prepared.warnings.insert(prepared.warnings.end(), body->warnings.begin(), body->warnings.end());
  return prepared;
}

}  // namespace bulbus::inline app
