#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace bulbus::inline problem {

/// Refuses a surface that neither closes by itself nor by the symmetry planes through the origin ("x", "y",
/// "z"): every edge belongs to an even number of faces, or lies in such a plane. Throws InputError with the
/// place of the first open edge.
void require_closed(const Mesh& mesh, const std::vector<Quad>& faces, std::span<const std::string> symmetry,
                    const std::string& surface, const std::string& key);

/// Axis number of "x", "y", "z".
int axis_of(const std::string& name);

/// A length by which the mesh's own round-off can be told from a distance: 1e-9 of its size.
double mesh_tolerance(const Mesh& mesh);

}  // namespace bulbus::inline problem
