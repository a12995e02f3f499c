#pragma once
#include "app/eye/eye.hpp"
#include "core/mesh/mesh_count.hpp"

namespace bulbus::inline eye {

/// What generate() will make, without making it: hexahedra exactly, nodes within 2 %. Throws InputError as
/// generate() does.
MeshCount count(const EyeSettings& settings);

}  // namespace bulbus::inline eye
