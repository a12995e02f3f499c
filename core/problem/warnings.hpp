#pragma once
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// What a person should know of a model that runs all the same: `check` prints these sentences, `run` writes
/// them to its log and to summary.json. `mesh`: the one that was read or generated. The same on every rank.
std::vector<std::string> warnings_of(const Mesh& mesh, const Model& model);

}  // namespace bulbus::inline problem
