#pragma once
#include <charconv>
#include <optional>
#include <string_view>

namespace bulbus {

/// The number that the whole of a text is, as std::from_chars reads it; none where it is anything else.
template <class T>
std::optional<T> parse_number(std::string_view text) {
  T value{};
  const char* const last = text.data() + text.size();
  const auto [end, failure] = std::from_chars(text.data(), last, value);
  return failure == std::errc() && end == last ? std::optional(value) : std::nullopt;
}

}  // namespace bulbus
