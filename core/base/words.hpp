#pragma once
#include <array>
#include <concepts>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace bulbus {

/// An enumeration that scenes, help and records write as words. `words(E)`, beside the enumeration, lists
/// them in the order of the enumerators, which count from 0.
template <class E>
concept Worded = std::is_enum_v<E> && requires(E e) {
  { words(e)[0] } -> std::convertible_to<std::string_view>;
};

template <Worded E>
std::string word_of(E value) {
  return std::string(words(value)[static_cast<std::size_t>(value)]);
}

template <Worded E>
std::vector<std::string> all_words() {
  const auto list = words(E{});
  return {list.begin(), list.end()};
}

/// Throws std::invalid_argument if no enumerator is written so.
template <Worded E>
E from_word(std::string_view word) {
  const auto list = words(E{});
  for (std::size_t i = 0; i < list.size(); ++i)
    if (list[i] == word) return static_cast<E>(i);
  throw std::invalid_argument("'" + std::string(word) + "' is not among the choices");
}

}  // namespace bulbus
