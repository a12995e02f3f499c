#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "core/mesh/vtk/vtk_grid.hpp"

namespace bulbus::inline mesh {
namespace {

template <class T>
std::vector<double> convert(std::string_view bytes, bool swapped) {
  std::vector<double> numbers(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes.data() + i * sizeof(T), sizeof(T));
    if (swapped) std::ranges::reverse(raw);
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    numbers[i] = static_cast<double>(value);
  }
  return numbers;
}

}  // namespace

int size_of(VtkType type) { return std::array{1, 1, 2, 2, 4, 4, 8, 8, 4, 8}[static_cast<int>(type)]; }

std::vector<double> numbers_in(std::string_view bytes, VtkType type, bool swapped) {
  switch (type) {
    case VtkType::i8:
      return convert<std::int8_t>(bytes, swapped);
    case VtkType::u8:
      return convert<std::uint8_t>(bytes, swapped);
    case VtkType::i16:
      return convert<std::int16_t>(bytes, swapped);
    case VtkType::u16:
      return convert<std::uint16_t>(bytes, swapped);
    case VtkType::i32:
      return convert<std::int32_t>(bytes, swapped);
    case VtkType::u32:
      return convert<std::uint32_t>(bytes, swapped);
    case VtkType::i64:
      return convert<std::int64_t>(bytes, swapped);
    case VtkType::u64:
      return convert<std::uint64_t>(bytes, swapped);
    case VtkType::f32:
      return convert<float>(bytes, swapped);
    default:
      return convert<double>(bytes, swapped);
  }
}

}  // namespace bulbus::inline mesh
