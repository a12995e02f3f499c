#pragma once
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Refuses what leaves open on which body a pressure acts, or how often: liquids and contacts on faces with
/// hexahedra on both sides, pressures there without a region, a surface of two liquids, two pressures on one
/// surface in one step. The surfaces that are named must exist. Throws InputError.
void require_clear_pressures(const Mesh& mesh, const Model& model);

/// Surfaces that share faces and both carry a pressure: there the pressures add up.
std::vector<std::string> overlapping_pressures(const Mesh& mesh, const Model& model);

}  // namespace bulbus::inline problem
