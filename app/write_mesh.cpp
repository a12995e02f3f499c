#include "app/commands.hpp"
#include "app/scene/size_limits.hpp"
#include "core/base/error.hpp"

namespace bulbus::inline app {

int write_mesh(const Scene& scene, const std::string& file, const GmshFormat& format, const Comm& comm) {
  std::string fault;
  try {
    if (comm.rank() == 0) {
      if (const auto base = count_of(scene.mesh)) refuse_too_large_to_make(*base, scene);
      const MeshHierarchy meshes = make_meshes(scene.mesh);
      if (scene.mesh.file) refuse_too_large_to_make(count(meshes.base), scene);
      write_gmsh(meshes.finest(), file, format);
    }
  } catch (const InputError& e) {
    fault = e.what();
  }
  if (comm.any(!fault.empty())) throw InputError(fault, "mesh");
  return 0;
}

}  // namespace bulbus::inline app
