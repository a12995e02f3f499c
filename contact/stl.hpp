#pragma once
#include <string>

#include "contact/skin.hpp"

namespace bulbus {

/// Reads an STL file, text or binary. Equal corners become one point; triangles with two equal corners are
/// left out. The normals of the file are not used: the order of the corners says which side is out. Throws
/// InputError with the line (binary: the triangle).
Skin read_stl(const std::string& path);

}  // namespace bulbus
