#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/eye/eye.hpp"
#include "core/base/parameters.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/mesh_count.hpp"
#include "core/mesh/refine.hpp"

namespace bulbus::inline app {

/// Where the mesh comes from: a file, or one of the shapes that can be generated.
struct MeshSource {
  std::optional<std::string> file;
  std::optional<EyeSettings> eye;
  std::optional<BlockShape> block;
  std::optional<ShellShape> shell;
  std::optional<BallShape> ball;
  std::optional<CylinderShape> cylinder;
  double scale = 1;
  std::string regions = "region";
  std::map<std::string, std::string> sets, surfaces;
  int refine = 0;
  template <class V>
  void describe(V&& v) {
    v("file", file,
      About{"mesh of 8-node hexahedra: Gmsh (MSH 4.1 or 2.2), Abaqus (.inp) or VTK (.vtu, .vtk); lengths "
            "in mm, but for `scale`"});
    v("scale", scale, About{"multiplies the coordinates of `file`: 1000 for a file in metres"}.positive());
    v("regions", regions, About{"cell array of a .vtu or .vtk `file` whose whole numbers name the regions"});
    v("eye", eye, About{"the parametric half eye"});
    v("block", block, About{"a box of equal cells"});
    v("shell", shell, About{"a spherical shell, or a part of one"});
    v("ball", ball, About{"a solid ball, or a part of one"});
    v("cylinder", cylinder, About{"a solid cylinder about z"});
    v("sets", sets,
      About{"node sets by a condition on X, Y, Z (mm) before `refine`: \"X < 0.1\""}.expression());
    v("surfaces", surfaces,
      About{"surfaces by a condition: the outer faces all of whose nodes satisfy it, \"X*X + Y*Y < 1.01\""}
          .expression());
    v("refine", refine,
      About{"times that every hexahedron is split in eight: new nodes lie on the generated shape, amid those "
            "of a file"}
          .between(0, 8));
  }
  /// Throws InputError unless exactly one source is given.
  void validate() const;
};

/// What a mesh file was read without, as ReadMesh has it, and where a generated shape is not as asked for.
struct ToldOfMesh {
  std::vector<std::string> notes, warnings;
};

/// How large the base will be; nothing where it is read from a file. Throws InputError if the source
/// contradicts itself.
std::optional<MeshCount> count_of(const MeshSource& source);

/// Reads or generates the base, whole on every rank; `told` gains the notes and warnings of it. `settle` may
/// move its nodes before conditions of sets and surfaces are asked. Throws InputError.
MeshHierarchy make_meshes(const MeshSource& source, ToldOfMesh* told = nullptr,
                          const std::function<void(Mesh&)>& settle = {});

}  // namespace bulbus::inline app
