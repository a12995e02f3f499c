#pragma once
#include <optional>
#include <string>

#include "app/eye/eye.hpp"
#include "core/base/parameters.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/mesh_count.hpp"
#include "core/mesh/refine.hpp"

namespace bulbus {

/// Where the mesh comes from: a file, or one of the shapes that can be generated.
struct MeshSource {
  std::optional<std::string> file;
  std::optional<EyeSettings> eye;
  std::optional<BlockShape> block;
  std::optional<ShellShape> shell;
  std::optional<BallShape> ball;
  std::optional<CylinderShape> cylinder;
  double scale = 1;
  int refine = 0;
  template <class V>
  void describe(V&& v) {
    v("file", file, About{"Gmsh file (MSH 4.1 or 2.2) of 8-node hexahedra; lengths in mm, but for `scale`"});
    v("scale", scale, About{"multiplies the coordinates of `file`: 1000 for a file in metres"}.positive());
    v("eye", eye, About{"the parametric half eye"});
    v("block", block, About{"a box of equal cells"});
    v("shell", shell, About{"a spherical shell, or a part of one"});
    v("ball", ball, About{"a solid ball, or a part of one"});
    v("cylinder", cylinder, About{"a solid cylinder about z"});
    v("refine", refine,
      About{"times that every hexahedron is split in eight: new nodes lie on the generated shape, amid those "
            "of a file"}
          .between(0, 8));
  }
  /// Throws InputError unless exactly one source is given.
  void validate() const;
};

/// How large the base will be; nothing where it is read from a file. Throws InputError if the source
/// contradicts itself.
std::optional<MeshCount> count_of(const MeshSource& source);

/// Reads or generates the base, whole on every rank. Throws InputError.
MeshHierarchy make_meshes(const MeshSource& source);

}  // namespace bulbus
