#include "app/scene/mesh_source.hpp"

#include "app/eye/eye_count.hpp"
#include "app/scene/mesh_sets.hpp"
#include "core/base/error.hpp"
#include "core/base/require_one.hpp"
#include "core/mesh/read_mesh.hpp"

namespace bulbus::inline app {

void MeshSource::validate() const {
  if (scale != 1 && !file)
    throw input_error("`scale` is given for a mesh that is not read from a file",
                      "leave it out, or give the shape its lengths in mm");
  if (regions != MeshSource{}.regions && !(file && is_vtk(*file)))
    throw input_error("`regions` is given for a mesh that is not read from a .vtu or .vtk file",
                      "leave it out: the file or the shape names its regions itself");
  require_one("the mesh", "source", optional_members(*this));
}

namespace {

Mesh read_scaled(const MeshSource& source, ToldOfMesh* told) {
  ReadMesh read = read_mesh(*source.file, source.regions);
  for (Point& p : read.mesh.points)
    for (double& x : p) x *= source.scale;
  if (told) *told = {std::move(read.notes), std::move(read.warnings)};
  return std::move(read.mesh);
}

Mesh make_base(const MeshSource& source, ToldOfMesh* told) {
  if (source.file) return read_scaled(source, told);
  if (source.eye) {
    if (std::string other = unlike_tear(*source.eye); told && !other.empty())
      told->warnings.push_back(std::move(other));
    return generate(*source.eye);
  }
  if (source.block) return generate(*source.block);
  if (source.shell) return generate(*source.shell);
  if (source.ball) return generate(*source.ball);
  return generate(*source.cylinder);
}

}  // namespace

std::optional<MeshCount> count_of(const MeshSource& source) {
  source.validate();
  if (source.eye) return count(*source.eye);
  if (source.block) return count(*source.block);
  if (source.shell) return count(*source.shell);
  if (source.ball) return count(*source.ball);
  if (source.cylinder) return count(*source.cylinder);
  return {};
}

MeshHierarchy make_meshes(const MeshSource& source, ToldOfMesh* told,
                          const std::function<void(Mesh&)>& settle) {
  source.validate();
  Mesh base = make_base(source, told);
  if (settle) settle(base);
  add_sets(base, source.sets);
  add_surfaces(base, source.surfaces);
  return refined(std::move(base), source.refine);
}

}  // namespace bulbus::inline app
