#pragma once
#include <functional>
#include <span>

#include "core/solve/coupled_system.hpp"

namespace bulbus::inline solve {

/// Tᵀ K T of one small contribution: its reduced dofs and the dense matrix between them, by rows. A reduced
/// dof is 3·node + c of a local node, or 3·nodes + 6·body + i of a rigid body.
using ReducedVisitor = std::function<void(std::span<const int> dofs, std::span<const double> matrix)>;

/// Of hexahedra: the tangent; with γ b W bᵀ; augmented means, as smoothers apply them (Solid::visit_mean);
/// these with a tenth of γ.
enum class Matrices { plain, augmented, mean, reduced_augmentation };

/// Everything of the linearised displacement block that this rank's elements, terms and liquids contribute,
/// in reduced dofs: constrained directions projected out, nodes of bodies mapped to their six. Identity parts
/// of constrained directions are not among it.
void for_each_condensed_matrix(const CoupledSystem& system, Matrices matrices, const ReducedVisitor& visitor);

/// Places of the nodes' first entries among reduced dofs, between which bodies have six each. `nodal`:
/// 3·nodes.
inline void first_of_nodes(std::span<const int> dofs, int nodal, std::vector<std::size_t>& firsts) {
  firsts.clear();
  for (std::size_t i = 0; i < dofs.size(); i += dofs[i] < nodal ? 3 : 6)
    if (dofs[i] < nodal) firsts.push_back(i);
}

/// T of a single column block: for local nodes with their nodal values, the reduced dofs and values (Tᵀ v).
void reduce_vector(const Problem& problem, const State& state, std::span<const int> nodes,
                   std::span<const double> v, std::vector<int>& dofs, std::vector<double>& values);

}  // namespace bulbus::inline solve
