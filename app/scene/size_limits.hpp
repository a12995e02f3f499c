#pragma once
#include <vector>

#include "app/memory/memory_parts.hpp"
#include "core/base/parallel.hpp"
#include "core/mesh/mesh_count.hpp"

namespace bulbus::inline app {

/// Refuses, before it is made, a mesh whose nodes or hexahedra cannot be numbered, or that needs more memory
/// than there is: while it is prepared, or later by the solver as far as counts tell. Throws InputError with
/// the key `mesh`.
void refuse_too_large(const MeshCount& base, const Scene& scene, int ranks);

/// The same where the mesh is made whole, by one process, and not solved on.
void refuse_too_large_to_make(const MeshCount& base, const Scene& scene);

/// Bytes that a run may take, and in words who says so: "that this machine has".
double memory_of(const LinearSettings& settings);
std::string whose_memory(const LinearSettings& settings);

/// Throws InputError if these parts are more than `solver.linear.memory_limit` allows, or this machine.
void refuse_more_than_there_is(const std::vector<MemoryPart>& parts, const LinearSettings& settings);

}  // namespace bulbus::inline app
