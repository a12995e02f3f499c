#include "precond/coarse/aggregates.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <unordered_map>

#include "precond/amg/scalar_matrices.hpp"

namespace bulbus {
namespace {

// Strongly coupled owned neighbours of every owned node: Σ_c |A_ij,cc| > threshold √(tr A_ii tr A_jj).
std::vector<std::vector<int>> strong_neighbours(const CoupledSystem& system) {
  const auto scalar = scalar_matrices(system);
  constexpr double threshold = 0.02;
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
      if (j >= 0 && j != i && value(k) > threshold * std::sqrt(diagonal[i] * diagonal[j]))
        strong[i].push_back(j);
    }
  return strong;
}

// Group of every owned node, counted from 0 on this rank; −1 of those that have none.
std::vector<int> grow_groups(const DofMap& dofs, const std::vector<std::vector<int>>& strong, int size) {
  const int owned = static_cast<int>(strong.size());
  constexpr int unassigned = -2;
  std::vector<int> of(owned, unassigned);
  for (int n = 0; n < owned; ++n)
    if (dofs.constrained(n) && trace(dofs.projector(n)) < 0.5) of[n] = -1;
  int next = 0;
  std::deque<int> seeds;  // the rim of what is done: new groups grow beside old ones
  const auto grow = [&](int seed) {
    std::deque<int> front{seed};
    of[seed] = next;
    int members = 1;
    while (!front.empty() && members < size) {
      const int n = front.front();
      front.pop_front();
      for (int m : strong[n])
        if (of[m] == unassigned && members < size) {
          of[m] = next;
          ++members;
          front.push_back(m);
        }
    }
    for (int n : front)
      for (int m : strong[n])
        if (of[m] == unassigned) seeds.push_back(m);
    ++next;
  };
  for (int n = 0; n < owned; ++n) {
    if (of[n] == unassigned) seeds.push_back(n);
    while (!seeds.empty()) {
      const int seed = seeds.front();
      seeds.pop_front();
      if (of[seed] == unassigned) grow(seed);
    }
  }
  return of;
}

// Small aggregates join a neighbour; numbers without gaps again. Returns how many groups there are.
int join_small_aggregates(std::vector<int>& of, const std::vector<std::vector<int>>& strong) {
  constexpr int least = 4;
  std::vector<int> members(of.size());
  for (int a : of)
    if (a >= 0) ++members[a];
  for (std::size_t n = 0; n < of.size(); ++n)
    if (of[n] >= 0 && members[of[n]] < least)
      for (int m : strong[n])
        if (of[m] >= 0 && members[of[m]] >= least) {
          of[n] = of[m];
          break;
        }
  std::unordered_map<int, int> number;
  for (int& a : of)
    if (a >= 0) a = number.emplace(a, static_cast<int>(number.size())).first->second;
  return static_cast<int>(number.size());
}

}  // namespace

Aggregates aggregate(const CoupledSystem& system, int nodes) {
  const LocalMesh& mesh = system.problem().mesh();
  const auto strong = strong_neighbours(system);
  auto of = grow_groups(system.problem().dofs(), strong, nodes);
  Aggregates a;
  a.mine = join_small_aggregates(of, strong);
  a.bodies = static_cast<int>(system.problem().dofs().bodies().size());
  a.first = a.bodies + static_cast<int>(mesh.comm.offset(a.mine));
  a.total = a.bodies + static_cast<int>(mesh.comm.sum(static_cast<long long>(a.mine)));
  std::vector<double> number(mesh.nodes(), -1);
  for (int n = 0; n < mesh.owned; ++n)
    if (of[n] >= 0) number[n] = a.first + of[n];
  mesh.halo.update_ghosts(number, 1);
  a.of.assign(number.begin(), number.end());
  return a;
}

}  // namespace bulbus
