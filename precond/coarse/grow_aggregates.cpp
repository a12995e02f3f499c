#include "precond/coarse/grow_aggregates.hpp"

#include <deque>
#include <unordered_map>

namespace bulbus::inline precond {
namespace {

using Graph = std::vector<std::vector<int>>;

std::vector<int> grow_groups(const Graph& neighbours, int size, const std::vector<char>& excluded) {
  const int vertices = static_cast<int>(neighbours.size());
  constexpr int unassigned = -2;
  std::vector<int> of(vertices, unassigned);
  for (int n = 0; n < vertices; ++n)
    if (excluded[n]) of[n] = -1;
  int next = 0;
  std::deque<int> seeds;  // the rim of what is done: new groups grow beside old ones
  const auto grow = [&](int seed) {
    std::deque<int> front{seed};
    of[seed] = next;
    int members = 1;
    while (!front.empty() && members < size) {
      const int n = front.front();
      front.pop_front();
      for (int m : neighbours[n])
        if (of[m] == unassigned && members < size) {
          of[m] = next;
          ++members;
          front.push_back(m);
        }
    }
    for (int n : front)
      for (int m : neighbours[n])
        if (of[m] == unassigned) seeds.push_back(m);
    ++next;
  };
  for (int n = 0; n < vertices; ++n) {
    if (of[n] == unassigned) seeds.push_back(n);
    while (!seeds.empty()) {
      const int seed = seeds.front();
      seeds.pop_front();
      if (of[seed] == unassigned) grow(seed);
    }
  }
  return of;
}

// Small aggregates join a neighbour; numbers without gaps again.
void join_small_aggregates(std::vector<int>& of, const Graph& neighbours) {
  constexpr int least = 4;  // three nodes may lie on a line, which has but five rigid motions
  std::vector<int> members(of.size());
  for (int a : of)
    if (a >= 0) ++members[a];
  for (std::size_t n = 0; n < of.size(); ++n)
    if (of[n] >= 0 && members[of[n]] < least)
      for (int m : neighbours[n])
        if (of[m] >= 0 && members[of[m]] >= least) {
          of[n] = of[m];
          break;
        }
  std::unordered_map<int, int> number;
  for (int& a : of)
    if (a >= 0) a = number.emplace(a, static_cast<int>(number.size())).first->second;
}

}  // namespace

std::vector<int> grow_aggregates(const Graph& neighbours, int size, const std::vector<char>& excluded) {
  auto of = grow_groups(neighbours, size, excluded);
  join_small_aggregates(of, neighbours);
  return of;
}

}  // namespace bulbus::inline precond
