#pragma once
#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/pack.hpp"
#include "core/base/parallel.hpp"

namespace bulbus {

/// Σ a_i b_i in double precision over `n` numbers of this rank, summed by lanes.
template <class A, class B>
double local_inner_product(const A* a, const B* b, std::size_t n) {
  Pack sum(0.0);
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) sum += load(a + i) * load(b + i);
  double total = 0;
  for (int l = 0; l < lanes; ++l) total += sum[l];
  for (; i < n; ++i) total += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return total;
}

/// Σ a_i b_i of this rank. Both as long as the shorter of the two.
template <class A, class B>
double local_inner_product(const A& a, const B& b) {
  return local_inner_product(std::data(a), std::data(b), std::min(std::size(a), std::size(b)));
}

/// Σ a_i b_i over all ranks. Collective.
template <class A, class B>
double inner_product(const A& a, const B& b, const Comm& comm) {
  return comm.sum(local_inner_product(a, b));
}

/// y += factor · a, over the entries of a.
inline void add_scaled(std::span<const double> a, double factor, std::span<double> y) {
  for (std::size_t i = 0; i < a.size(); ++i) y[i] += factor * a[i];
}

/// Euclidean norm over all ranks. Collective.
template <class A>
double norm(const A& a, const Comm& comm) {
  return std::sqrt(inner_product(a, a, comm));
}

}  // namespace bulbus
