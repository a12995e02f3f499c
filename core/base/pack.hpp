#pragma once
#include <array>
#include <bit>
#include <cmath>
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

using PackBits = std::int64_t __attribute__((vector_size(lanes * sizeof(double))));

/// x between two bounds; a NaN stays one.
inline double clamped(double x, double low, double high) { return x < low ? low : x > high ? high : x; }
inline Pack clamped(const Pack& x, double low, double high) {
  const Pack least(low), most(high);
  return Pack(Pack::Vector(x.v < least.v ? least.v : x.v > most.v ? most.v : x.v));
}

/// y where x > bound, else 0.
inline double where_above(double bound, double x, double y) { return x > bound ? y : 0; }
inline Pack where_above(double bound, const Pack& x, const Pack& y) {
  return Pack(Pack::Vector(x.v > Pack(bound).v ? y.v : Pack(0.).v));
}

/// 2^n for whole n between -1022 and 1024, which is infinite.
inline double power_of_two(double n) {
  return std::bit_cast<double>((static_cast<std::int64_t>(n) + 1023) << 52);
}
inline Pack power_of_two(const Pack& n) {
  return Pack(std::bit_cast<Pack::Vector>((__builtin_convertvector(n.v, PackBits) + 1023) << 52));
}

/// e^x to two units in the last place, as 2^n e^r with |r| ≤ ½ ln 2 and a Taylor polynomial of degree 13 in
/// r; infinite from x = 709.5 on, 1e-308 below x = -708.
template <class T>
T exponential(const T& x) {
  constexpr double per_ln2 = 1.4426950408889634, ln2_high = 6.93147180369123816490e-01,
                   ln2_low = 1.90821492927058770002e-10;  // ln 2 in two parts: n ln2_high is exact
  constexpr double shift = 0x1.8p52;                      // added and taken away it rounds to a whole number
  const T y = clamped(x, -708, 710), n = (y * per_ln2 + shift) - shift;
  const T r = (y - n * ln2_high) - n * ln2_low;
  constexpr double inverse_factorial[] = {1. / 479001600, 1. / 39916800, 1. / 3628800, 1. / 362880,
                                          1. / 40320,     1. / 5040,     1. / 720,     1. / 120,
                                          1. / 24,        1. / 6};
  T p(1. / 6227020800);
  for (double c : inverse_factorial) p = p * r + c;
  const T tail = r * r * (0.5 + r * p);
  return power_of_two(n) * (1.0 + (r + tail));
}

}  // namespace bulbus
