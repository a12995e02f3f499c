#pragma once
#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Moves nodes that lie beside a plane of symmetry by no more than `symmetry_tolerance` onto it, so that they
/// are constrained there and stay there in refinements. By default that is 1e-5 of the mesh's diagonal, and
/// no more than a fiftieth of a node's edges.
void move_onto_planes(Mesh& mesh, const Model& model);

/// Refuses a mesh that lies on both sides of a plane of symmetry, and one with faces of its boundary that lie
/// along a plane, nearer to it than a fiftieth of their edges, and are not constrained there, and one that a
/// plane does not meet. Throws InputError with distance and place.
void require_at_planes(const Mesh& mesh, const Model& model);

}  // namespace bulbus::inline problem
