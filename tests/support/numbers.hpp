#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/tensor.hpp"
#include "core/base/worse.hpp"

namespace bulbus {

/// Uniform in [-1, 1], a function of its keys alone: every rank and every run draws the same number for the
/// same thing.
inline double noise(std::uint64_t seed, std::uint64_t key) {
  std::uint64_t z = seed * 0x9E3779B97F4A7C15 + key * 0xBF58476D1CE4E5B9 + 0x94D049BB133111EB;
  for (int i = 0; i < 3; ++i) z = (z ^ (z >> 29)) * 0xBF58476D1CE4E5B9 + 0x9E3779B97F4A7C15;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-52 - 1;
}

inline std::vector<double> noise_vector(std::size_t n, std::uint64_t seed) {
  std::vector<double> v(n);
  for (std::size_t i = 0; i < n; ++i) v[i] = noise(seed, i);
  return v;
}

inline double largest(std::span<const double> v) {
  double m = 0;
  for (double x : v) m = worse(m, std::abs(x));
  return m;
}

/// Largest |a − b| over largest |b|. A NaN, which no comparison bears, where the sizes differ and where b is
/// empty or zero: that proves nothing.
inline double relative_difference(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size() || largest(b) == 0) return NAN;
  std::vector<double> d(a.begin(), a.end());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] -= b[i];
  return largest(d) / largest(b);
}

inline double inner(std::span<const double> a, std::span<const double> b) {
  double s = 0;
  for (std::size_t i = 0; i < a.size(); ++i) s += a[i] * b[i];
  return s;
}

inline std::vector<double> plus(std::span<const double> a, double factor, std::span<const double> b) {
  std::vector<double> s(a.begin(), a.end());
  for (std::size_t i = 0; i < s.size(); ++i) s[i] += factor * b[i];
  return s;
}

/// d/dh f(x + h d) at h = 0 of a vector-valued f: central differences of fourth order.
template <class F>
std::vector<double> derivative(F f, std::span<const double> x, std::span<const double> d, double h = 1e-3) {
  const auto at = [&](double t) { return f(plus(x, t, d)); };
  std::vector<double> r = at(h);
  const auto a = at(-h), b = at(2 * h), c = at(-2 * h);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = (8 * (r[i] - a[i]) - (b[i] - c[i])) / (12 * h);
  return r;
}

inline Mat3<double> random_matrix(std::uint64_t seed) {
  Mat3<double> m;
  for (int i = 0; i < 9; ++i) m(i / 3, i % 3) = noise(seed, i);
  return m;
}

/// I + amplitude · noise
inline Mat3<double> random_gradient(std::uint64_t seed, double amplitude) {
  Mat3<double> F = random_matrix(seed);
  for (int i = 0; i < 9; ++i) F(i / 3, i % 3) = (i % 4 == 0) + amplitude * F(i / 3, i % 3);
  return F;
}

}  // namespace bulbus
