#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/base/pack.hpp"
#include "core/base/tensor.hpp"

namespace bulbus {

/// The nodes of eight elements with N nodes each; unused lanes of the last pack repeat the last element.
template <std::size_t N>
struct PackNodes {
  std::array<std::array<int, lanes>, N> node;
  int used = lanes;
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
    }
  }
  return packs;
}

/// Nodal vectors (3 numbers a node) of the pack's elements.
template <std::size_t N>
std::array<Vec3<Pack>, N> gather(const PackNodes<N>& p, std::span<const double> v) {
  std::array<Vec3<Pack>, N> out;
  for (std::size_t a = 0; a < N; ++a) {
    const auto at = [&](int lane, int c) { return v[3 * static_cast<std::size_t>(p.node[a][lane]) + c]; };
    for (int c = 0; c < 3; ++c)
      out[a][c] = Pack(Pack::Vector{at(0, c), at(1, c), at(2, c), at(3, c), at(4, c), at(5, c), at(6, c), at(7, c)});
  }
  return out;
}

/// Adds the pack's nodal vectors into v, lane by lane.
template <std::size_t N>
void scatter_add(const PackNodes<N>& p, const std::array<Vec3<Pack>, N>& in, std::span<double> v) {
  for (std::size_t a = 0; a < N; ++a) {
    alignas(64) double x[3][lanes];
    for (int c = 0; c < 3; ++c) store(in[a][c], x[c]);
    for (int l = 0; l < p.used; ++l) {
      double* to = v.data() + 3 * static_cast<std::ptrdiff_t>(p.node[a][l]);
      to[0] += x[0][l], to[1] += x[1][l], to[2] += x[2][l];
    }
  }
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

}  // namespace bulbus
