#pragma once
#include "core/element/packing.hpp"
#include "core/element/q1.hpp"

namespace bulbus {

/// The nodes of two packs of hexahedra.
struct PackPair {
  const PackNodes<8>&low, &high;
  int used;  ///< elements, those of `low` first
  int node(int a, int lane) const { return lane < lanes ? low.node[a][lane] : high.node[a][lane - lanes]; }
};

/// x, y and z of sixteen nodes: loaded whole, and transposed.
inline Vec3<SinglePack> gather_nodes(const PackPair& p, int a, const NodeSingle* v) {
  using Vector = SinglePack::Vector;
  const auto four = [&](int lane) {  // x y z _ of the nodes lane, lane + 4, ...
    const auto at = [&](int l) { return v[p.node(a, l)]; };
    const auto lower = __builtin_shufflevector(at(lane), at(lane + 4), 0, 1, 2, 3, 4, 5, 6, 7);
    const auto upper = __builtin_shufflevector(at(lane + 8), at(lane + 12), 0, 1, 2, 3, 4, 5, 6, 7);
    return Vector(__builtin_shufflevector(lower, upper, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
  };
  const auto first = [](Vector a, Vector b) { return Vector(__builtin_shufflevector(a, b, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29)); };
  const auto second = [](Vector a, Vector b) { return Vector(__builtin_shufflevector(a, b, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31)); };
  const auto even = [](Vector a, Vector b) { return SinglePack(Vector(__builtin_shufflevector(a, b, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29))); };
  const auto odd = [](Vector a, Vector b) { return SinglePack(Vector(__builtin_shufflevector(a, b, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31))); };
  const Vector p0 = four(0), p1 = four(1), p2 = four(2), p3 = four(3);
  const Vector xy01 = first(p0, p1), xy23 = first(p2, p3);
  return {even(xy01, xy23), odd(xy01, xy23), even(second(p0, p1), second(p2, p3))};
}

/// Nodal vectors of the pair's elements.
inline NodalVectors<SinglePack> gather(const PackPair& p, std::span<const NodeSingle> v) {
  NodalVectors<SinglePack> out;
  for (int a = 0; a < 8; ++a) out[a] = gather_nodes(p, a, v.data());
  return out;
}

/// Adds x, y and z to sixteen nodes, one after the other: elements may share one.
inline void scatter_add_nodes(const PackPair& p, int a, const Vec3<SinglePack>& in, NodeSingle* v) {
  using Vector = SinglePack::Vector;
  const auto first = [](Vector a, Vector b) { return Vector(__builtin_shufflevector(a, b, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29)); };
  const auto second = [](Vector a, Vector b) { return Vector(__builtin_shufflevector(a, b, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31)); };
  const auto even = [](Vector a, Vector b) { return Vector(__builtin_shufflevector(a, b, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29)); };
  const auto odd = [](Vector a, Vector b) { return Vector(__builtin_shufflevector(a, b, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31)); };
  const Vector zero{};
  const Vector xy01 = first(in[0].v, in[1].v), xy23 = second(in[0].v, in[1].v), z01 = first(in[2].v, zero), z23 = second(in[2].v, zero);
  const Vector four[4] = {even(xy01, z01), odd(xy01, z01), even(xy23, z23), odd(xy23, z23)};  // x y z 0 of the nodes i, i + 4, ...
  alignas(64) NodeSingle of[4][4];
  std::memcpy(of, four, sizeof of);
  if (p.used == 2 * lanes)
#pragma GCC unroll 16
    for (int l = 0; l < 2 * lanes; ++l) v[p.node(a, l)] += of[l % 4][l / 4];
  else
    for (int l = 0; l < p.used; ++l) v[p.node(a, l)] += of[l % 4][l / 4];
}

inline void scatter_add(const PackPair& p, const NodalVectors<SinglePack>& in, std::span<NodeSingle> v) {
  for (int a = 0; a < 8; ++a) scatter_add_nodes(p, a, in[a], v.data());
}

}  // namespace bulbus
