#pragma once
#include <set>
#include <span>

#include "core/mesh/mesh.hpp"

namespace bulbus {

/// The tissue right under the faces of a surface.
struct Layer {
  double thickness;       ///< least way through it, mm: from each face through opposite faces to where the region ends
  std::set<int> regions;  ///< of the hexahedra that have the faces
};

Layer layer_under(const Mesh& mesh, std::span<const Quad> faces);

}  // namespace bulbus
