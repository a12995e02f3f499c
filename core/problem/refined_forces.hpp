#pragma once
#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Refuses forces on sets that refinement gives more nodes: every node carries the force, so that their sum
/// would grow. `mesh`: the one that will be refined. The sets must exist. Throws InputError.
void require_forces_kept(const Mesh& mesh, const Model& model);

}  // namespace bulbus::inline problem
