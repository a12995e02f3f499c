#pragma once
#include <set>
#include <span>

#include "core/base/parallel.hpp"
#include "core/mesh/mesh.hpp"

namespace bulbus::inline contact {

/// The tissue right under the faces of a surface.
struct Layer {
  double thickness;  ///< least way through it, mm: from each face through opposite faces to where the region
                     ///< ends
  std::set<int> regions;  ///< of the hexahedra that have the faces
};

/// On the mesh that so many refinements make of `base`, whose faces these are: ways are refined one by one,
/// each on one rank. Collective.
Layer layer_under(const Mesh& base, std::span<const Quad> faces, int refinements, const Comm& comm);

}  // namespace bulbus::inline contact
