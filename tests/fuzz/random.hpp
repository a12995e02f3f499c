#pragma once
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace bulbus::fuzz {

/// The numbers behind one mutant: the same seed and index give the same mutant on every machine.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index)
      : engine_(mixed(seed * 0x9E3779B97F4A7C15 + mixed(index))) {}

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
  static std::uint64_t mixed(std::uint64_t z) {  // splitmix64
    z += 0x9E3779B97F4A7C15;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
    return z ^ (z >> 31);
  }
  std::mt19937_64 engine_;
};

}  // namespace bulbus::fuzz
