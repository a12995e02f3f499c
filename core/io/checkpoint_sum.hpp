#pragma once
#include <bit>
#include <cstdint>
#include <span>
#include <string>

#include "core/base/mixed_bits.hpp"

namespace bulbus::inline io {

/// Check sum over the datasets of a checkpoint: a sum over their numbers, so that ranks add up theirs in any
/// order.
class CheckpointSum {
 public:
  static constexpr std::uint64_t bits = (std::uint64_t{1} << 40) - 1;  // the sum of many ranks is no overflow

  /// Number i of `values` is number first + i of the dataset.
  template <class T>
  void add(const std::string& dataset, long long first, std::span<const T> values) {
    std::uint64_t name = 1469598103934665603u;  // FNV-1a
    for (unsigned char c : dataset) name = (name ^ c) * 1099511628211u;
    for (std::size_t i = 0; i < values.size(); ++i)
      sum_ += mixed_bits(mixed_bits(name + static_cast<std::uint64_t>(first) + i) ^ word(values[i])) & bits;
  }
  long long value() const { return static_cast<long long>(sum_ & bits); }

 private:
  static std::uint64_t word(double v) { return std::bit_cast<std::uint64_t>(v); }
  static std::uint64_t word(long long v) { return static_cast<std::uint64_t>(v); }
  static std::uint64_t word(unsigned char v) { return v; }

  std::uint64_t sum_ = 0;
};

}  // namespace bulbus::inline io
