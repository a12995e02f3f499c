#pragma once
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// One sentence per pair of regions where nodes of one lie on outer faces of the other, of which they are no
/// corners, and no contact joins the two sides: what looks like one body there is two, or is joined at
/// corners alone. A node lies on a face if it is nearer than a hundredth of the face's shortest edge.
std::vector<std::string> hanging_nodes(const Mesh& mesh, const Model& model);

}  // namespace bulbus::inline problem
