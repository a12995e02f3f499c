#pragma once
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Node sets of `fix` and `displace` that have all nodes of a hexahedron, as both faces of a sheet of one
/// layer have: refinement gives them the nodes inside as well. A sentence for each. `mesh`: the one that will
/// be refined. The sets must exist.
std::vector<std::string> thickened_sets(const Mesh& mesh, const Model& model);

/// Those of the named surfaces that have all nodes of a hexahedron, as where a condition means the end of a
/// body and holds at two layers of nodes: the sides of that layer are faces of the surface as well. A
/// sentence for each.
std::vector<std::string> thickened_surfaces(const Mesh& mesh, const std::vector<std::string>& names);

}  // namespace bulbus::inline problem
