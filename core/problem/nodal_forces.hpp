#pragma once
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Refuses forces on sets that refinement gives more nodes: every node carries the force, so that their sum
/// would grow. `mesh`: the one that will be refined. The sets must exist. Throws InputError.
void require_forces_kept(const Mesh& mesh, const Model& model);

/// Forces on nodes of planes of symmetry: there the drawn part and its image both carry the force, so that
/// the whole has twice of it. A sentence for each.
std::vector<std::string> forces_on_planes(const Mesh& mesh, const Model& model);

}  // namespace bulbus::inline problem
