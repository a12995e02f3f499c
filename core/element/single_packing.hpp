#pragma once
#include "core/element/packing.hpp"
#include "core/element/q1.hpp"

namespace bulbus::inline element {

/// The nodes of two packs of hexahedra.
struct PackPair {
  const PackNodes<8>&low, &high;
  int used;  ///< elements, those of `low` first
  int node(int a, int lane) const { return lane < lanes ? low.node[a][lane] : high.node[a][lane - lanes]; }
};

/// x y z w of the nodes i, i + 4, i + 8, i + 12 for every i of four, taken to x, y, z and w of sixteen nodes;
/// and back.
inline std::array<SinglePack::Vector, 4> transposed(SinglePack::Vector a, SinglePack::Vector b,
                                                    SinglePack::Vector c, SinglePack::Vector d) {
  using Vector = SinglePack::Vector;
  const auto first = [](Vector l, Vector r) {
    return Vector(__builtin_shufflevector(l, r, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29));
  };
  const auto second = [](Vector l, Vector r) {
    return Vector(__builtin_shufflevector(l, r, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31));
  };
  const auto even = [](Vector l, Vector r) {
    return Vector(__builtin_shufflevector(l, r, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29));
  };
  const auto odd = [](Vector l, Vector r) {
    return Vector(__builtin_shufflevector(l, r, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31));
  };
  const Vector xy01 = first(a, b), xy23 = first(c, d), zw01 = second(a, b), zw23 = second(c, d);
  return {even(xy01, xy23), odd(xy01, xy23), even(zw01, zw23), odd(zw01, zw23)};
}

/// x, y and z of sixteen nodes: loaded whole, and transposed.
inline Vec3<SinglePack> gather_nodes(const PackPair& p, int a, const NodeSingle* v) {
  using Vector = SinglePack::Vector;
  const auto four = [&](int lane) {
    const auto at = [&](int l) { return v[p.node(a, l)]; };
    const auto lower = __builtin_shufflevector(at(lane), at(lane + 4), 0, 1, 2, 3, 4, 5, 6, 7);
    const auto upper = __builtin_shufflevector(at(lane + 8), at(lane + 12), 0, 1, 2, 3, 4, 5, 6, 7);
    return Vector(
        __builtin_shufflevector(lower, upper, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15));
  };
  const auto xyzw = transposed(four(0), four(1), four(2), four(3));
  return {SinglePack(xyzw[0]), SinglePack(xyzw[1]), SinglePack(xyzw[2])};
}

/// Nodal vectors of the pair's elements.
inline NodalVectors<SinglePack> gather(const PackPair& p, std::span<const NodeSingle> v) {
  NodalVectors<SinglePack> out;
  for (int a = 0; a < 8; ++a) out[a] = gather_nodes(p, a, v.data());
  return out;
}

/// Adds x, y and z to sixteen nodes, one after the other: elements may share one.
inline void scatter_add_nodes(const PackPair& p, int a, const Vec3<SinglePack>& in, NodeSingle* v) {
  const auto four = transposed(in[0].v, in[1].v, in[2].v, SinglePack(0.).v);
  alignas(64) NodeSingle of[4][4];  // of the nodes i, i + 4, ...
  std::memcpy(of, four.data(), sizeof of);
  if (p.used == 2 * lanes)
#pragma GCC unroll 16
    for (int l = 0; l < 2 * lanes; ++l) v[p.node(a, l)] += of[l % 4][l / 4];
  else
    for (int l = 0; l < p.used; ++l) v[p.node(a, l)] += of[l % 4][l / 4];
}

inline void scatter_add(const PackPair& p, const NodalVectors<SinglePack>& in, std::span<NodeSingle> v) {
  for (int a = 0; a < 8; ++a) scatter_add_nodes(p, a, in[a], v.data());
}

}  // namespace bulbus::inline element
