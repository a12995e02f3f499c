#pragma once
#include "core/element/packing.hpp"

namespace bulbus {

/// The nodes of two packs of hexahedra.
struct PackPair {
  const PackNodes<8>&low, &high;
  int used;  ///< elements, those of `low` first
  int node(int a, int lane) const { return lane < lanes ? low.node[a][lane] : high.node[a][lane - lanes]; }
};

/// x, y and z of sixteen nodes: whole nodes are loaded as four numbers, the fourth of which is dropped, and transposed. One number
/// must follow the last node.
inline Vec3<SinglePack> gather_nodes(const PackPair& p, int a, const float* v) {
  using Four = float __attribute__((vector_size(16)));
  using Vector = SinglePack::Vector;
  const auto four = [&](int lane) {  // x y z _ of the nodes lane, lane + 4, ...
    Four n[4];
    for (int i = 0; i < 4; ++i) std::memcpy(&n[i], v + 3 * static_cast<std::ptrdiff_t>(p.node(a, lane + 4 * i)), sizeof n[i]);
    const auto lower = __builtin_shufflevector(n[0], n[1], 0, 1, 2, 3, 4, 5, 6, 7), upper = __builtin_shufflevector(n[2], n[3], 0, 1, 2, 3, 4, 5, 6, 7);
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

/// Nodal vectors (3 numbers a node) of the pair's elements.
inline std::array<Vec3<SinglePack>, 8> gather(const PackPair& p, std::span<const float> v) {
  std::array<Vec3<SinglePack>, 8> out;
  if (3 * static_cast<std::size_t>(std::max(p.low.last, p.high.last)) + 3 < v.size()) {
    for (int a = 0; a < 8; ++a) out[a] = gather_nodes(p, a, v.data());
    return out;
  }
  for (int a = 0; a < 8; ++a)
    for (int c = 0; c < 3; ++c)
      for (int l = 0; l < 2 * lanes; ++l) out[a][c].v[l] = v[3 * static_cast<std::size_t>(p.node(a, l)) + c];
  return out;
}

/// Adds x, y and z to sixteen nodes, as the double one does.
inline void scatter_add_nodes(const PackPair& p, int a, const Vec3<SinglePack>& in, float* v) {
  using Two = float __attribute__((vector_size(2 * sizeof(float))));
  const SingleVector xy[2] = {
      __builtin_shufflevector(in[0].v, in[1].v, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29),
      __builtin_shufflevector(in[0].v, in[1].v, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31)};
  alignas(64) float pairs[2][2 * lanes], z[2 * lanes];
  std::memcpy(pairs, xy, sizeof pairs);
  std::memcpy(z, &in[2].v, sizeof z);
  const auto add = [&](int l) {
    float* to = v + 3 * static_cast<std::ptrdiff_t>(p.node(a, l));
    Two sum, part;
    std::memcpy(&sum, to, sizeof sum);
    std::memcpy(&part, pairs[l / 2 % 2] + l / 4 * 4 + l % 2 * 2, sizeof part);
    sum += part;
    std::memcpy(to, &sum, sizeof sum);
    to[2] += z[l];
  };
  if (p.used == 2 * lanes)
    for (int l = 0; l < 2 * lanes; ++l) add(l);
  else
    for (int l = 0; l < p.used; ++l) add(l);
}

inline void scatter_add(const PackPair& p, const std::array<Vec3<SinglePack>, 8>& in, std::span<float> v) {
  for (int a = 0; a < 8; ++a) scatter_add_nodes(p, a, in[a], v.data());
}

/// One number per element, `used` of them from `first` on; the others are zero.
inline SinglePack load_single(std::span<const double> v, int first, int used) {
  alignas(64) float x[2 * lanes] = {};
  for (int l = 0; l < used; ++l) x[l] = static_cast<float>(v[first + l]);
  SinglePack p;
  std::memcpy(&p.v, x, sizeof x);
  return p;
}

}  // namespace bulbus
