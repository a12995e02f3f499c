#include "app/report/pack.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/base64.hpp"
#include "core/io/deflate.hpp"

namespace bulbus::inline app {
namespace {

// Byte k of all values, for every k: high bytes of small differences are equal, which deflates well.
template <class T>
std::string text_of(const std::vector<T>& differences) {
  std::vector<std::byte> planes;
  planes.reserve(sizeof(T) * differences.size());
  for (std::size_t k = 0; k < sizeof(T); ++k)
    for (T d : differences) planes.push_back(static_cast<std::byte>(d >> (8 * k) & 255));
  return base64(deflated(planes));
}

}  // namespace

std::vector<std::uint16_t> quantised(std::span<const float> values, float low, float high) {
  const double scale = high > low ? quantum_top / (static_cast<double>(high) - low) : 0;
  std::vector<std::uint16_t> quanta(values.size());
  std::ranges::transform(values, quanta.begin(), [&](float v) {
    if (std::isnan(v)) return no_value;
    return static_cast<std::uint16_t>(std::clamp(std::round((v - low) * scale), 0., double{quantum_top}));
  });
  return quanta;
}

std::string packed(std::span<const std::uint16_t> values, std::span<const std::uint16_t> before) {
  std::vector<std::uint16_t> differences(values.begin(), values.end());
  for (std::size_t i = 0; i < std::min(before.size(), differences.size()); ++i) differences[i] -= before[i];
  return text_of(differences);
}

std::string packed(std::span<const std::uint32_t> values, std::size_t stride) {
  std::vector<std::uint32_t> differences(values.begin(), values.end());
  for (std::size_t i = differences.size(); i-- > stride;) differences[i] -= differences[i - stride];
  return text_of(differences);
}

}  // namespace bulbus::inline app
