#include "app/prepare.hpp"

#include "contact/operation_probes.hpp"
#include "core/base/error.hpp"
#include "core/problem/tissues.hpp"

namespace bulbus {
namespace {

MeshHierarchy meshes_of(const Scene& scene, const Comm& comm) {
  MeshHierarchy meshes;
  try {
    comm.together([&] {
      meshes = make_meshes(scene.mesh);
      refuse_inverted(meshes.finest());
    });
  } catch (const InputError& fault) {
    throw InputError(fault.what(), "mesh");
  }
  return meshes;
}

void rehearse(const Mesh& mesh, const Model& model, const Comm& comm) {
  Problem problem(mesh, model, comm);
  const auto operation = Operation::attach(problem, mesh);
  const ProbeSet probes(problem, operation_probes(operation));
  problem.rehearse(static_cast<int>(model.steps.size()));
}

}  // namespace

Prepared prepare(const Scene& scene, const Comm& comm) {
  scene.validate();
  const MeshHierarchy meshes = meshes_of(scene, comm);
  const Mesh& mesh = meshes.finest();
  Model model = scene.model;
  add_tissues(model, mesh.region_names);
  rehearse(mesh, model, comm);
  auto problem = scene.solver.linear.wants_hierarchy() ? std::make_unique<Problem>(meshes, model, comm)
                                                       : std::make_unique<Problem>(mesh, model, comm);
  Prepared prepared{std::move(problem), nullptr, quality(mesh)};
  prepared.operation = Operation::attach(*prepared.problem, mesh);
  return prepared;
}

}  // namespace bulbus
