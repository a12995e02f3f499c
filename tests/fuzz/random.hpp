#pragma once
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "core/base/mixed_bits.hpp"

namespace bulbus::fuzz {

/// The numbers behind one mutant: the same seed and index give the same mutant on every machine.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index)
      : engine_(mixed_bits(seed * 0x9E3779B97F4A7C15 + mixed_bits(index))) {}

  /// 0 to n − 1; n > 0.
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }
  int between(int low, int high) {
    return low + static_cast<int>(below(static_cast<std::size_t>(high - low + 1)));
  }
  bool one_in(std::size_t n) { return below(n) == 0; }
  template <class T>
  const T& of(const std::vector<T>& values) {
    return values[below(values.size())];
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace bulbus::fuzz
