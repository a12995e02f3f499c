#pragma once
#include <cstdint>

namespace bulbus {

/// The 64 bits of a number, each of which depends on all of them (splitmix64): for check sums, hashes and
/// seeds.
constexpr std::uint64_t mixed_bits(std::uint64_t z) {
  z += 0x9E3779B97F4A7C15;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EB;
  return z ^ (z >> 31);
}

}  // namespace bulbus
