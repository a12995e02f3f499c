#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace bulbus {

/// Eight elements are computed side by side, one per lane.
constexpr int lanes = 8;

/// Several numbers, of the compiler's vector type V, in a struct that broadcasts; wider or narrower machines
/// split it.
template <class V>
struct PackOf {
  using Vector = V;
  using Number = std::remove_cvref_t<decltype(V{}[0])>;
  V v;

  PackOf() = default;
  PackOf(double x) : v(V{} + static_cast<Number>(x)) {}
  explicit PackOf(V x) : v(x) {}
  PackOf& operator+=(const PackOf& b) { return v += b.v, *this; }
  PackOf& operator-=(const PackOf& b) { return v -= b.v, *this; }
  PackOf& operator*=(const PackOf& b) { return v *= b.v, *this; }
  Number operator[](int lane) const { return v[lane]; }
  friend PackOf operator+(const PackOf& a, const PackOf& b) { return PackOf(V(a.v + b.v)); }
  friend PackOf operator-(const PackOf& a, const PackOf& b) { return PackOf(V(a.v - b.v)); }
  friend PackOf operator*(const PackOf& a, const PackOf& b) { return PackOf(V(a.v * b.v)); }
  friend PackOf operator/(const PackOf& a, const PackOf& b) { return PackOf(V(a.v / b.v)); }
  friend PackOf operator-(const PackOf& a) { return PackOf(V(-a.v)); }
};

using DoubleVector = double __attribute__((vector_size(lanes * sizeof(double))));
using SingleVector = float __attribute__((vector_size(2 * lanes * sizeof(float))));
using Pack = PackOf<DoubleVector>;
/// Two packs side by side in single precision: the same registers for twice the elements.
using SinglePack = PackOf<SingleVector>;

/// x, y and z of a node in single precision, loaded at once, and a number that nobody reads.
using NodeSingle = float __attribute__((vector_size(4 * sizeof(float))));
inline NodeSingle rounded(const double* v) {
  return NodeSingle{static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]), 0};
}
inline std::span<float> numbers(std::span<NodeSingle> v) {
  return {reinterpret_cast<float*>(v.data()), 4 * v.size()};
}

/// Is any of the numbers not zero?
inline bool any(const Pack& x) {
  for (int l = 0; l < lanes; ++l)
    if (x[l] != 0) return true;
  return false;
}

inline Pack load(const double* p) {
  Pack::Vector v;
  std::memcpy(&v, p, sizeof v);
  return Pack(v);
}
inline void store(const Pack& x, double* p) { std::memcpy(p, &x.v, sizeof x.v); }

using FloatVector = float __attribute__((vector_size(lanes * sizeof(float))));
inline Pack load(const float* p) {
  FloatVector f;
  std::memcpy(&f, p, sizeof f);
  return Pack(__builtin_convertvector(f, Pack::Vector));
}
inline void store(const Pack& x, float* p) {
  const FloatVector f = __builtin_convertvector(x.v, FloatVector);
  std::memcpy(p, &f, sizeof f);
}

/// Asks for `count` numbers that will be needed soon: the processor itself does not look beyond a page. They
/// need not exist.
inline void prefetch(const float* first, int count) {
  constexpr int line = 64 / sizeof(float);
  for (int i = 0; i < count; i += line) __builtin_prefetch(first + i, 0, 2);
}

/// One step towards x^(-1/3), by the series in the error e = 1 − x y³ up to e³: what is left is e⁴/7.
template <class T>
T refined_inverse_cube_root(const T& x, const T& y) {
  const T e = 1.0 - x * (y * y * y);
  return y + y * (e * (1.0 / 3 + e * (2.0 / 9 + e * (14.0 / 81))));
}

/// x^(-1/3) for normal x > 0: an estimate from the exponent bits (3 %), then two steps to round-off.
/// For x ≤ 0, which only a rejected trial state has, the result is not used.
inline double inverse_cube_root(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  const double guess = std::bit_cast<double>(0x553EF0FF289DD796 - bits / 3);
  return refined_inverse_cube_root(x, refined_inverse_cube_root(x, guess));
}

inline Pack inverse_cube_root(const Pack& x) {
  using Bits = std::int64_t __attribute__((vector_size(lanes * sizeof(double))));
  const Pack::Vector third = __builtin_convertvector(std::bit_cast<Bits>(x.v), Pack::Vector) * (1.0 / 3);
  const Bits guess = 0x553EF0FF289DD796 - __builtin_convertvector(third, Bits);
  return refined_inverse_cube_root(x, refined_inverse_cube_root(x, Pack(std::bit_cast<Pack::Vector>(guess))));
}

}  // namespace bulbus
