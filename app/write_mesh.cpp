#include "app/commands.hpp"
#include "core/base/error.hpp"

namespace bulbus {

int write_mesh(const Scene& scene, const std::string& file, const GmshFormat& format, const Comm& comm) {
  std::string fault;
  try {
    if (comm.rank() == 0) write_gmsh(make_meshes(scene.mesh).finest(), file, format);
  } catch (const InputError& e) {
    fault = e.what();
  }
  if (comm.any(!fault.empty())) throw InputError(fault);
  return 0;
}

}  // namespace bulbus
