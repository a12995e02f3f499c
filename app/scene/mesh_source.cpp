#include "app/scene/mesh_source.hpp"

#include "app/eye/eye_count.hpp"
#include "core/base/error.hpp"
#include "core/base/require_one.hpp"
#include "core/mesh/gmsh/gmsh.hpp"

namespace bulbus {

void MeshSource::validate() const {
  if (scale != 1 && !file)
    throw input_error("`scale` is given for a mesh that is not read from a file",
                      "leave it out, or give the shape its lengths in mm");
  require_one("the mesh", "source", optional_members(*this));
}

namespace {

Mesh read_scaled(const std::string& file, double scale) {
  Mesh mesh = read_gmsh(file);
  for (Point& p : mesh.points)
    for (double& x : p) x *= scale;
  return mesh;
}

Mesh make_base(const MeshSource& source) {
  if (source.file) return read_scaled(*source.file, source.scale);
  if (source.eye) return generate(*source.eye);
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

MeshHierarchy make_meshes(const MeshSource& source) {
  source.validate();
  return refined(make_base(source), source.refine);
}

}  // namespace bulbus
