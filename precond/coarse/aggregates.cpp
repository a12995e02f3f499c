#include "precond/coarse/aggregates.hpp"

#include <algorithm>
#include <cmath>

#include "precond/amg/scalar_matrices.hpp"
#include "precond/coarse/grow_aggregates.hpp"

namespace bulbus::inline precond {
namespace {

// Strongly coupled owned neighbours of every owned node: Σ_c |A_ij,cc| > strong_coupling √(tr A_ii tr A_jj).
std::vector<std::vector<int>> strong_neighbours(const CoupledSystem& system) {
  const auto scalar = scalar_matrices(system);
  const LocalMesh& mesh = system.problem().mesh();
  const int owned = mesh.owned;
  const auto value = [&](std::size_t k) {
    return std::abs(scalar[0].values[k]) + std::abs(scalar[1].values[k]) + std::abs(scalar[2].values[k]);
  };
  const auto local = [&](long long number) {
    const long long n = number - mesh.first_node;
    return n >= 0 && n < owned ? static_cast<int>(n) : -1;
  };
  std::vector<double> diagonal(owned);
  for (int i = 0; i < owned; ++i)
    for (int k = scalar[0].start[i]; k < scalar[0].start[i + 1]; ++k)
      if (local(scalar[0].columns[k]) == i) diagonal[i] = value(k);
  std::vector<std::vector<int>> strong(owned);
  for (int i = 0; i < owned; ++i)
    for (int k = scalar[0].start[i]; k < scalar[0].start[i + 1]; ++k) {
      const int j = local(scalar[0].columns[k]);
      if (j >= 0 && j != i && value(k) > strong_coupling * std::sqrt(diagonal[i] * diagonal[j]))
        strong[i].push_back(j);
    }
  return strong;
}

bool wholly_held(const DofMap& dofs, int node) {
  return dofs.constrained(node) && trace(dofs.projector(node)) < 0.5;
}

}  // namespace

Aggregates aggregate(const CoupledSystem& system, int nodes) {
  const LocalMesh& mesh = system.problem().mesh();
  const DofMap& dofs = system.problem().dofs();
  std::vector<char> excluded(mesh.owned);
  for (int n = 0; n < mesh.owned; ++n) excluded[n] = wholly_held(dofs, n);
  const auto of = grow_aggregates(strong_neighbours(system), nodes, excluded);
  Aggregates a;
  a.mine = of.empty() ? 0 : std::ranges::max(of) + 1;
  a.bodies = static_cast<int>(dofs.bodies().size());
  a.first = a.bodies + static_cast<int>(mesh.comm.offset(a.mine));
  a.total = a.bodies + static_cast<int>(mesh.comm.sum(static_cast<long long>(a.mine)));
  std::vector<double> number(mesh.nodes(), -1);
  for (int n = 0; n < mesh.owned; ++n)
    if (of[n] >= 0) number[n] = a.first + of[n];
  mesh.halo.update_ghosts(number, 1);
  a.of.assign(number.begin(), number.end());
  return a;
}

bool hold_every_free_node(const Aggregates& groups, const Problem& problem) {
  bool lacks = false;
  for (int n = 0; n < problem.mesh().owned; ++n) lacks |= groups.of[n] < 0 && !wholly_held(problem.dofs(), n);
  return !problem.comm().any(lacks);
}

}  // namespace bulbus::inline precond
