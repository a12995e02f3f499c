#pragma once
#include <string>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline app {

/// Why a step cannot be told to another program; empty where it can.
std::string untold(const Model& model, const Mesh& mesh, int step);

}  // namespace bulbus::inline app
