#include "precond/smoothers/lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/mesh/corners.hpp"
#include "core/mesh/hex_edges.hpp"

namespace bulbus::inline precond {
namespace {

struct Edge {
  int a, b;
  double strength;
};

double squared_length(std::span<const double> X, int a, int b) {
  double sum = 0;
  for (int c = 0; c < 3; ++c) sum += std::pow(X[3 * a + c] - X[3 * b + c], 2);
  return sum;
}

// Each edge once, between owned nodes, at the lower one's place.
std::vector<Edge> edges_of(const Problem& problem) {
  const LocalMesh& mesh = problem.mesh();
  const auto V = problem.solid().reference_volumes();
  std::vector<std::vector<Edge>> of(mesh.owned);
  for (const SolidRegion& r : problem.solid().regions()) {
    const double mu = initial_shear_modulus(r.material);
    for (int h = r.first; h < r.first + r.count; ++h)
      for (const auto& e : hex_edges) {
        const auto [a, b] = std::minmax(mesh.hexes[h][e[0]], mesh.hexes[h][e[1]]);
        if (b >= mesh.owned) continue;
        const double strength = mu * V[h] / squared_length(mesh.X, a, b);
        const auto known = std::ranges::find(of[a], b, &Edge::b);
        if (known == of[a].end())
          of[a].push_back({a, b, strength});
        else
          known->strength += strength;
      }
  }
  std::vector<Edge> edges;
  for (auto& some : of) {
    std::ranges::sort(some, {}, &Edge::b);
    edges.insert(edges.end(), some.begin(), some.end());
  }
  return edges;
}

// What a node has besides its two strongest edges: the strength of the third.
std::vector<double> third_strongest(const std::vector<Edge>& edges, int owned) {
  std::vector<std::array<double, 3>> top(owned, {0, 0, 0});
  for (const Edge& e : edges)
    for (int n : {e.a, e.b}) {
      double s = e.strength;
      for (double& t : top[n])
        if (s > t) std::swap(s, t);
    }
  std::vector<double> third;
  for (const auto& t : top) third.push_back(t[2]);
  return third;
}

bool share_hexahedron(const LocalMesh& mesh, const Corners& corners, int a, int b) {
  return std::ranges::any_of(corners.at(a), [&](const auto& c) {
    return std::ranges::find(mesh.hexes[c.hex()], b) != mesh.hexes[c.hex()].end();
  });
}

// The neighbours of every node in its line, or −1. Lines run straight, so that only neighbours on them are
// coupled.
std::vector<std::array<int, 2>> link(std::vector<Edge> edges, const LocalMesh& mesh) {
  // In equal cells strengths are equal; they go with 1/ℓ², so that lines begin at an aspect of √2.
  constexpr double strong = 2;
  const int owned = mesh.owned;
  const Corners corners(mesh.hexes, mesh.nodes());
  const auto third = third_strongest(edges, owned);
  for (Edge& e : edges) e.strength /= std::max(1e-300, std::min(third[e.a], third[e.b]));
  std::erase_if(edges, [](const Edge& e) { return e.strength < strong; });
  std::ranges::stable_sort(edges, [](const Edge& p, const Edge& q) { return p.strength > q.strength; });
  std::vector<std::array<int, 2>> next(owned, {-1, -1});
  DisjointSets joined(owned);
  const auto turns = [&](int end, int beyond) {
    return next[end][0] >= 0 && share_hexahedron(mesh, corners, next[end][0], beyond);
  };
  for (const Edge& e : edges) {
    if (next[e.a][1] >= 0 || next[e.b][1] >= 0 || joined.root(e.a) == joined.root(e.b) || turns(e.a, e.b) ||
        turns(e.b, e.a))
      continue;
    joined.join(e.a, e.b);
    next[e.a][next[e.a][0] >= 0] = e.b;
    next[e.b][next[e.b][0] >= 0] = e.a;
  }
  return next;
}

}  // namespace

Lines find_lines(const Problem& problem) {
  const int owned = problem.mesh().owned;
  const auto next = link(edges_of(problem), problem.mesh());
  Lines lines;
  std::vector<bool> done(owned);
  for (int n = 0; n < owned; ++n) {
    if (done[n] || next[n][1] >= 0) continue;  // not an end
    for (int before = -1, at = n; at >= 0;) {
      done[at] = true;
      lines.nodes.push_back(at);
      const int ahead = next[at][0] != before ? next[at][0] : next[at][1];
      before = std::exchange(at, ahead);
    }
    lines.start.push_back(static_cast<int>(lines.nodes.size()));
  }
  return lines;
}

}  // namespace bulbus::inline precond
