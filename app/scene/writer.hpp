#pragma once
#include "app/scene/entry.hpp"
#include "app/scene/kinds.hpp"
#include "app/scene/wording.hpp"

/// Writes any struct that describes itself as an Entry, defaults and all; what is optional and empty is left
/// out.
namespace bulbus::writer {

template <class T>
Entry entry_of(T& value, const About& about);

template <kinds::Described T>
Entry entry_of_struct(T& object) {
  Entry map = Entry::empty(Entry::Kind::map);
  object.describe([&](const char* key, auto& member, const About& about) {
    Entry entry = entry_of(member, about);
    if (!entry.is(Entry::Kind::nothing)) map.insert(key, {}, std::move(entry));
  });
  return map;
}

template <class T>
Entry entry_of_list(T& list, const About& about) {
  Entry entry = Entry::empty(Entry::Kind::list);
  for (auto&& item : list) entry.items.push_back(entry_of(item, about));
  return entry;
}

template <kinds::Map T>
Entry entry_of_map(T& map, const About& about) {
  Entry entry = Entry::empty(Entry::Kind::map);
  for (auto& [key, value] : map) entry.insert(key, {}, entry_of(value, about));
  return entry;
}

template <class T>
Entry entry_of(T& value, const About& about) {
  if constexpr (kinds::Described<T>) return entry_of_struct(value);
  if constexpr (kinds::Optional<T>)
    return value                     ? entry_of(*value, about)
           : about.zero_is_automatic ? Entry::word("0")
                                     : Entry::empty(Entry::Kind::nothing);
  if constexpr (kinds::Map<T>) return entry_of_map(value, about);
  if constexpr (std::same_as<T, Entry>) return value;
  Entry entry;
  if constexpr (kinds::List<T> || std::same_as<T, Point>) entry = entry_of_list(value, about);
  if constexpr (std::same_as<T, std::string>) entry = Entry::word(value);
  if constexpr (Worded<T>) entry = Entry::word(word_of(value));
  if constexpr (std::same_as<T, bool>) entry = Entry::word(value ? "true" : "false");
  if constexpr (std::same_as<T, int>) entry = Entry::word(std::to_string(value));
  if constexpr (std::same_as<T, double>) entry = Entry::word(number_text(value));
  entry.note = unit_of(about.quantity);
  return entry;
}

}  // namespace bulbus::writer
