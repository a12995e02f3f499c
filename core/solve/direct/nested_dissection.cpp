#include "core/solve/direct/nested_dissection.hpp"

#include <metis.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace bulbus::inline solve {
namespace {

// Neighbours of every unknown, in both directions, itself left out.
struct Graph {
  std::vector<std::vector<int>> neighbours;
  std::vector<char> zero;  // on the diagonal
};

Graph gathered_graph(const Triplets& t, int n, const Comm& comm) {
  std::vector<long long> pairs;
  for (std::size_t k = 0; k < t.row.size(); ++k)
    if (t.value[k] != 0) pairs.insert(pairs.end(), {t.row[k], t.col[k]});
  const auto all = comm.size() > 1 ? comm.gather(std::span<const long long>(pairs)) : std::move(pairs);
  Graph g{std::vector<std::vector<int>>(n), std::vector<char>(n, 1)};
  for (std::size_t k = 0; k < all.size(); k += 2) {
    const int i = static_cast<int>(all[k]), j = static_cast<int>(all[k + 1]);
    if (i == j)
      g.zero[i] = 0;
    else
      g.neighbours[i].push_back(j), g.neighbours[j].push_back(i);
  }
  for (auto& list : g.neighbours) {
    std::ranges::sort(list);
    list.erase(std::ranges::unique(list).begin(), list.end());
  }
  return g;
}

// Places of those without a zero; −1 for the others.
std::vector<int> metis_places(const Graph& g) {
  const int n = static_cast<int>(g.zero.size());
  std::vector<int> number(n, -1);
  idx_t vertices = 0;
  for (int i = 0; i < n; ++i)
    if (!g.zero[i]) number[i] = vertices++;
  std::vector<idx_t> start{0}, other, order(vertices), place(vertices);
  for (int i = 0; i < n; ++i) {
    if (g.zero[i]) continue;
    for (int j : g.neighbours[i])
      if (!g.zero[j]) other.push_back(number[j]);
    start.push_back(static_cast<idx_t>(other.size()));
  }
  if (vertices > 0 && METIS_NodeND(&vertices, start.data(), other.data(), nullptr, nullptr, order.data(),
                                   place.data()) != METIS_OK)
    throw std::runtime_error("METIS found no order of elimination");
  for (int& i : number)
    if (i >= 0) i = place[i];
  return number;
}

}  // namespace

std::vector<int> nested_dissection(const Triplets& matrix, int n, const Comm& comm) {
  const Graph g = gathered_graph(matrix, n, comm);
  const std::vector<int> place = metis_places(g);
  std::vector<std::pair<int, bool>> after(n);  // place of the last neighbour, and whether it is one's own
  for (int i = 0; i < n; ++i) {
    after[i] = {place[i], g.zero[i] != 0};
    if (g.zero[i])
      for (int j : g.neighbours[i]) after[i].first = std::max(after[i].first, place[j]);
  }
  std::vector<int> order(n), position(n);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](int i) { return after[i]; });
  for (int k = 0; k < n; ++k) position[order[k]] = k;
  return position;
}

}  // namespace bulbus::inline solve
