#pragma once
#include <string>
#include <vector>

#include "contact/rigid/surface_triangulation.hpp"

namespace bulbus::inline contact {

/// The surface that an STL file describes.
struct StlSurface : SurfaceTriangulation {
  std::vector<int> places;  ///< per triangle, the line where its facet begins (binary: its number from 1)
  bool text = true;
};

/// Reads an STL file, text or binary. Equal corners become one point; facets with two equal corners and
/// facets that repeat an earlier one are left out, which a warning tells. The normals of the file
/// are not used: the order of the corners says which side is out. Throws InputError with the line (binary:
/// the facet).
StlSurface read_stl(const std::string& path);

/// Refuses a surface that bounds no body: facets that are turned against their neighbours or have no area,
/// edges of one facet or of more than two, bodies that are inside out. Throws InputError with the place.
void require_body(const StlSurface& surface, const std::string& path);

}  // namespace bulbus::inline contact
