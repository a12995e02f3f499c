#include "benchmarks/machine.hpp"

#include <algorithm>
#include <vector>

#include "benchmarks/common.hpp"

namespace bulbus::bench {

double triad_bandwidth(int megabytes, int repetitions) {
  const std::size_t n = static_cast<std::size_t>(megabytes) * 1000000 / sizeof(double);
  std::vector<double> a(n, 1), b(n, 2), c(n, 3), rates;
  for (int r = 0; r < repetitions; ++r) {
    const double start = cpu_seconds(), s = 1 + 1e-3 * r;
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + s * c[i];
    asm volatile("" : : "r"(a.data()) : "memory");
    rates.push_back(3 * n * sizeof(double) / (cpu_seconds() - start));
  }
  return median(rates);
}

double fma_peak(int repetitions) {
  using Vector = double __attribute__((vector_size(64)));
  constexpr int chains = 12, steps = 20000000;
  double best = 0;
  for (int r = 0; r < repetitions; ++r) {
    Vector x[chains], m = Vector{} + .999999, s = Vector{} + 1e-6;
    for (int i = 0; i < chains; ++i) x[i] = Vector{} + 1. * i;
    const double start = cpu_seconds();
    for (int k = 0; k < steps; ++k)
#pragma GCC unroll 12
      for (int i = 0; i < chains; ++i) x[i] = x[i] * m + s;
    const double seconds = cpu_seconds() - start;
    for (const Vector& v : x) asm volatile("" : : "m"(v));
    best = std::max(best, 2. * 8 * chains * steps / seconds);
  }
  return best;
}

}  // namespace bulbus::bench
