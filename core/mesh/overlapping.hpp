#pragma once
#include "core/mesh/mesh.hpp"

namespace bulbus::inline mesh {

/// Refuses two hexahedra on the same side of a face that both have: they overlap. Of three that have a face,
/// two do. Jacobians must be positive. Throws InputError that names the first two by their numbers from 1.
void refuse_overlapping(const Mesh& mesh);

}  // namespace bulbus::inline mesh
