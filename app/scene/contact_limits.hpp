#pragma once
#include "app/scene/scene.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline app {

/// Refuses drawn rigid bodies with more facets than contact can search in every iteration, or than there is
/// memory for. Throws InputError with the body's key.
void refuse_too_many_facets(const Scene& scene, int ranks);

/// The same for the points of contacts on this mesh, and for their pairs with the parts of bodies. Throws
/// InputError with the contact's key.
void refuse_too_many_points(const Mesh& base, const Scene& scene, int ranks);

}  // namespace bulbus::inline app
