#pragma once
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// One sentence per pair of regions with nodes in the same place that are not the same node and do not belong
/// to the two sides of a contact: what looks like one body there is two. Nodes count as in one place if they
/// are nearer than a hundredth of the mesh's shortest edge.
std::vector<std::string> coincident_nodes(const Mesh& mesh, const Model& model);

}  // namespace bulbus::inline problem
