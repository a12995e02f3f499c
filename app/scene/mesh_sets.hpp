#pragma once
#include <map>
#include <string>

#include "core/mesh/mesh.hpp"

namespace bulbus::inline app {

/// Adds node sets: the nodes whose positions satisfy the condition. Throws InputError with the key
/// `mesh.sets.NAME` where a condition is none, holds at no node, or the mesh has the name already.
void add_sets(Mesh& mesh, const std::map<std::string, std::string>& conditions);

/// Adds surfaces: the outer faces all of whose nodes satisfy the condition. Throws InputError likewise.
void add_surfaces(Mesh& mesh, const std::map<std::string, std::string>& conditions);

}  // namespace bulbus::inline app
