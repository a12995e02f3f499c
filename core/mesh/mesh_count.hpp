#pragma once
#include "core/mesh/eye/eye.hpp"
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus {

/// How large a mesh is, or will be; in double precision, as what a scene asks for may be beyond any integer.
struct MeshCount {
  double hexes = 0, nodes = 0;
};

/// What generate() will make, without making it: hexahedra exactly; nodes exactly for blocks and cylinders,
/// within 2 % for the eye, and for spheres those of each octant, though octants share some.
MeshCount count(const BlockShape& shape);
MeshCount count(const ShellShape& shape);
MeshCount count(const BallShape& shape);
MeshCount count(const CylinderShape& shape);
/// Throws InputError as generate() does.
MeshCount count(const EyeSettings& settings);
MeshCount count(const Mesh& mesh);

/// After every hexahedron has been split in eight so many times.
MeshCount refined(const MeshCount& base, int times);

}  // namespace bulbus
