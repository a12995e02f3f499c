#pragma once
#include <span>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/problem/model.hpp"

namespace bulbus::inline problem {

/// Unit vectors of the families of a region's hexahedra in the reference configuration, taken at the mean of
/// a hexahedron's nodes: 3 numbers of each family of each hexahedron. `X`: positions of the nodes; `key`
/// names the region's `fibres` in error messages. Throws InputError where a direction vanishes or is not
/// finite.
std::vector<double> fibre_directions(const FibresSpec& fibres, const std::string& key,
                                     std::span<const double> X, std::span<const Hex> hexes);

}  // namespace bulbus::inline problem
