#pragma once
#include "core/mesh/generate/generate.hpp"
#include "core/mesh/generate/o_grid.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

/// How large a mesh is, or will be; in double precision, as what a scene asks for may be beyond any integer.
struct MeshCount {
  double hexes = 0, nodes = 0;
};

/// What generate() will make, without making it: hexahedra exactly; nodes exactly for blocks and cylinders,
/// and for spheres those of each octant, though octants share some.
MeshCount count(const BlockShape& shape);
MeshCount count(const ShellShape& shape);
MeshCount count(const BallShape& shape);
MeshCount count(const CylinderShape& shape);
MeshCount count(const Mesh& mesh);

/// Quads and nodes of an o_grid(), whole or half.
MeshCount count(const DiscMap& map, bool half);

/// Of layers of hexahedra over so many quads and nodes.
MeshCount layered(const MeshCount& section, double layers);

/// After every hexahedron has been split in eight so many times.
MeshCount refined(const MeshCount& base, int times);

}  // namespace bulbus::inline mesh
