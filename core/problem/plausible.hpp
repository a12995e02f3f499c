#pragma once
#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Asks back where a number without a unit can hardly be meant in MPa or mm: a pressure of more than ten
/// times the shear modulus of the stiffest region, a displacement of more than five times the mesh's
/// diagonal. With its unit a number is taken as it stands. Throws InputError naming the key.
void require_plausible_sizes(const Mesh& mesh, const Model& model);

}  // namespace bulbus::inline problem
