#pragma once
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Bars in planes of symmetry whose shares are too large: each lies where its image lies, so that the whole
/// has both. A sentence for each group.
std::vector<std::string> bars_on_planes(const Mesh& mesh, const Model& model);

}  // namespace bulbus::inline problem
