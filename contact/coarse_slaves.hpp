#pragma once
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline contact {

/// Contacts of which only the slave's nodes are kept out, and whose master is another surface of the mesh
/// with smaller faces: its nodes enter between the slave's, and the force is too small. A sentence for each.
std::vector<std::string> coarse_slaves(const Mesh& mesh, const Model& model);

}  // namespace bulbus::inline contact
