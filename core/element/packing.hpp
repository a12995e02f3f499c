#pragma once
#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <vector>

#include "core/base/pack.hpp"
#include "core/base/tensor.hpp"

namespace bulbus::inline element {

/// The nodes of eight elements with N nodes each; unused lanes of the last pack repeat the last element.
template <std::size_t N>
struct PackNodes {
  std::array<std::array<int, lanes>, N> node;
  int used = lanes, last = 0;  ///< elements; greatest node
};

/// Packs of elements; `nodes_of(e)` gives the N nodes of element e.
template <std::size_t N, class NodesOf>
std::vector<PackNodes<N>> make_packs(int count, NodesOf nodes_of) {
  std::vector<PackNodes<N>> packs((count + lanes - 1) / lanes);
  for (int p = 0; p < static_cast<int>(packs.size()); ++p) {
    packs[p].used = std::min(lanes, count - p * lanes);
    for (int l = 0; l < lanes; ++l) {
      const std::array<int, N> nodes = nodes_of(p * lanes + std::min(l, packs[p].used - 1));
      for (std::size_t a = 0; a < N; ++a) packs[p].node[a][l] = nodes[a];
      packs[p].last = std::max(packs[p].last, *std::max_element(nodes.begin(), nodes.end()));
    }
  }
  return packs;
}

/// x, y and z of eight nodes: whole nodes are loaded as four numbers, the fourth of which belongs to the next
/// node and is dropped, and transposed. The node behind each must exist.
inline Vec3<Pack> gather_nodes(const std::array<int, lanes>& node, const double* v) {
  using Four = double __attribute__((vector_size(4 * sizeof(double))));
  using Vector = Pack::Vector;
  const auto pair = [&](int a, int b) {  // x y z _ of two nodes
    Four lower, upper;
    std::memcpy(&lower, v + 3 * static_cast<std::ptrdiff_t>(node[a]), sizeof lower);
    std::memcpy(&upper, v + 3 * static_cast<std::ptrdiff_t>(node[b]), sizeof upper);
    return Pack(__builtin_shufflevector(lower, upper, 0, 1, 2, 3, 4, 5, 6, 7));
  };
  const Vector p = pair(0, 4).v, q = pair(1, 5).v, r = pair(2, 6).v, s = pair(3, 7).v;
  const Vector pq = __builtin_shufflevector(p, q, 0, 8, 2, 10, 4, 12, 6, 14),
               rs = __builtin_shufflevector(r, s, 0, 8, 2, 10, 4, 12, 6, 14);
  const Vector pq_y = __builtin_shufflevector(p, q, 1, 9, 3, 11, 5, 13, 7, 15),
               rs_y = __builtin_shufflevector(r, s, 1, 9, 3, 11, 5, 13, 7, 15);
  return {Pack(__builtin_shufflevector(pq, rs, 0, 1, 8, 9, 4, 5, 12, 13)),
          Pack(__builtin_shufflevector(pq_y, rs_y, 0, 1, 8, 9, 4, 5, 12, 13)),
          Pack(__builtin_shufflevector(pq, rs, 2, 3, 10, 11, 6, 7, 14, 15))};
}

/// Nodal vectors (3 numbers a node) of the pack's elements.
template <std::size_t N>
std::array<Vec3<Pack>, N> gather(const PackNodes<N>& p, std::span<const double> v) {
  std::array<Vec3<Pack>, N> out;
  if (3 * static_cast<std::size_t>(p.last) + 3 < v.size()) {
    for (std::size_t a = 0; a < N; ++a) out[a] = gather_nodes(p.node[a], v.data());
    return out;
  }
  for (std::size_t a = 0; a < N; ++a)
    for (int c = 0; c < 3; ++c)
      for (int l = 0; l < lanes; ++l) out[a][c].v[l] = v[3 * static_cast<std::size_t>(p.node[a][l]) + c];
  return out;
}

/// Adds x, y and z to eight nodes, one after the other: elements may share one. Always as a pair and a single
/// number, so that the next load finds what a store has just written.
inline void scatter_add_nodes(const std::array<int, lanes>& node, int used, const Vec3<Pack>& in, double* v) {
  using Two = double __attribute__((vector_size(2 * sizeof(double))));
  alignas(64) double xy[2][lanes], z[lanes];
  store(Pack(__builtin_shufflevector(in[0].v, in[1].v, 0, 8, 2, 10, 4, 12, 6, 14)), xy[0]);
  store(Pack(__builtin_shufflevector(in[0].v, in[1].v, 1, 9, 3, 11, 5, 13, 7, 15)), xy[1]);
  store(in[2], z);
  const auto add = [&](int l) {
    double* to = v + 3 * static_cast<std::ptrdiff_t>(node[l]);
    Two sum, part;
    std::memcpy(&sum, to, sizeof sum);
    std::memcpy(&part, xy[l % 2] + l / 2 * 2, sizeof part);
    sum += part;
    std::memcpy(to, &sum, sizeof sum);
    to[2] += z[l];
  };
  if (used == lanes)
    for (int l = 0; l < lanes; ++l) add(l);
  else
    for (int l = 0; l < used; ++l) add(l);
}

/// Adds the pack's nodal vectors into v, lane by lane.
template <std::size_t N>
void scatter_add(const PackNodes<N>& p, const std::array<Vec3<Pack>, N>& in, std::span<double> v) {
  for (std::size_t a = 0; a < N; ++a) scatter_add_nodes(p.node[a], p.used, in[a], v.data());
}

/// One number per element, `used` of them from `first` on.
inline Pack load_some(std::span<const double> v, int first, int used) {
  if (used == lanes) return load(v.data() + first);
  alignas(64) double x[lanes] = {};
  for (int l = 0; l < used; ++l) x[l] = v[first + l];
  return load(x);
}
inline void store_some(const Pack& value, std::span<double> v, int first, int used) {
  if (used == lanes) return store(value, v.data() + first);
  alignas(64) double x[lanes];
  store(value, x);
  for (int l = 0; l < used; ++l) v[first + l] = x[l];
}

}  // namespace bulbus::inline element
